use std::collections::BTreeMap;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::{Module, Names, Use};

/// Puts the module in `file`, and those in braces in it, into `modules`.
pub(super) fn file(modules: &mut BTreeMap<Names, Module>, file: &str, names: Names, text: &str) {
    let tokens: TokenStream = text.parse().unwrap_or_else(|error| panic!("{file}: {error}"));
    let mut reader = Reader { modules, file };
    reader.open(&names);
    reader.code(&names, tokens);
}

struct Reader<'a> {
    modules: &'a mut BTreeMap<Names, Module>,
    file: &'a str,
}

impl Reader<'_> {
    fn open(&mut self, names: &Names) {
        self.modules.entry(names.clone()).or_default().file = self.file.to_owned();
        if let Some((name, parent)) = names.split_last() {
            self.modules.entry(parent.to_vec()).or_default().children.insert(name.clone());
        }
    }

    fn code(&mut self, names: &Names, tokens: TokenStream) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut i = 0;
        while i < tokens.len() {
            i = match &tokens[i] {
                TokenTree::Ident(word) if word == "mod" => self.module(names, &tokens, i),
                TokenTree::Ident(word) if word == "pub" => i + 1 + usize::from(is_scope(tokens.get(i + 1))),
                // `use<..>` in a type imports nothing.
                TokenTree::Ident(word) if word == "use" && !is(tokens.get(i + 1), '<') => {
                    self.import(names, &tokens, i)
                }
                TokenTree::Ident(_) => self.path(names, &tokens, i),
                TokenTree::Group(group) => {
                    self.code(names, group.stream());
                    i + 1
                }
                _ => i + 1,
            };
        }
    }

    /// `mod name;` or `mod name { .. }`; returns what comes after.
    fn module(&mut self, names: &Names, tokens: &[TokenTree], i: usize) -> usize {
        let Some(TokenTree::Ident(name)) = tokens.get(i + 1) else { return i + 1 };
        if let Some(TokenTree::Group(group)) = tokens.get(i + 2)
            && group.delimiter() == Delimiter::Brace
        {
            let inner = [&names[..], &[name.to_string()]].concat();
            self.open(&inner);
            self.code(&inner, group.stream());
        }
        i + 3
    }

    /// `use ..;`; returns what comes after.
    fn import(&mut self, names: &Names, tokens: &[TokenTree], i: usize) -> usize {
        let before = if i > 0 && is_scope(tokens.get(i - 1)) { i.checked_sub(2) } else { i.checked_sub(1) };
        let public = before.is_some_and(|b| matches!(&tokens[b], TokenTree::Ident(word) if word == "pub"));
        let length = tokens[i..].iter().position(|token| is(Some(token), ';')).unwrap();
        let mut leaves = Vec::new();
        leaves_of(&tokens[i + 1..i + length], &mut Vec::new(), &mut leaves);
        let module = self.modules.get_mut(names).unwrap();
        module.uses.extend(leaves.into_iter().map(|(path, name)| Use { path, name, public }));
        i + length + 1
    }

    /// A path, of one name at least; returns what comes after.
    fn path(&mut self, names: &Names, tokens: &[TokenTree], mut i: usize) -> usize {
        let inside = i > 0 && is(tokens.get(i - 1), ':') && i > 1 && is(tokens.get(i - 2), ':');
        let mut path = vec![tokens[i].to_string()];
        i += 1;
        while is(tokens.get(i), ':') && is(tokens.get(i + 1), ':') {
            let Some(TokenTree::Ident(word)) = tokens.get(i + 2) else { break };
            path.push(word.to_string());
            i += 3;
        }
        // What begins with `::` is of another crate, or of a type.
        if !inside {
            let module = self.modules.get_mut(names).unwrap();
            module.words.insert(path[0].clone());
            if path.len() > 1 {
                module.paths.push(path);
            }
        }
        i
    }
}

/// The leaves of what stands behind a `use`, each with what it is called.
fn leaves_of(tokens: &[TokenTree], path: &mut Names, leaves: &mut Vec<(Names, String)>) {
    let depth = path.len();
    let mut name = None;
    for (i, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Ident(word) if word == "as" => name = tokens.get(i + 1).map(ToString::to_string),
            TokenTree::Ident(word) if name.is_none() => path.push(word.to_string()),
            TokenTree::Group(group) => {
                let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                for leaf in inner.split(|token| is(Some(token), ',')).filter(|leaf| !leaf.is_empty()) {
                    leaves_of(leaf, path, leaves);
                }
                path.truncate(depth);
                return;
            }
            TokenTree::Punct(punct) if punct.as_char() == '*' => name = Some("*".to_owned()),
            _ => {}
        }
    }
    if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
        path.pop();
    }
    let name = name.or_else(|| path.last().cloned()).unwrap();
    leaves.push((path.clone(), name));
    path.truncate(depth);
}

fn is(token: Option<&TokenTree>, punct: char) -> bool {
    matches!(token, Some(TokenTree::Punct(found)) if found.as_char() == punct)
}

/// Whether it is what may follow `pub`: `(crate)`, `(super)`, `(in ..)`.
fn is_scope(token: Option<&TokenTree>) -> bool {
    let Some(TokenTree::Group(group)) = token else { return false };
    let first = group.stream().into_iter().next();
    group.delimiter() == Delimiter::Parenthesis
        && matches!(first, Some(TokenTree::Ident(word)) if ["crate", "super", "self", "in"].iter().any(|w| word == w))
}
