//! What the YAML parser complains about, in words for people who did not write the parser.

/// The parser's `message`, and the likely slip where it is a common one: the parser often stops a line after it.
pub(super) fn in_words(message: &str) -> String {
    let slip = SLIPS.iter().find(|(said, _)| said.iter().any(|part| message.contains(part)));
    slip.map_or_else(|| message.to_owned(), |(_, words)| (*words).to_owned())
}

const SLIPS: [(&[&str], &str); 5] = [
    (&["tabs disallowed"], "found a tab; indent with spaces"),
    (
        &["mapping values are not allowed", "simple key expect ':'"],
        "a key without its ':', in this line or the one before",
    ),
    (&["illegal placement of ':'"], "a '[' or '{' in the lines before is not closed"),
    (
        &["while parsing a flow mapping", "while parsing a flow sequence"],
        "a '[' or '{' in this line or the ones before is not closed, or a ',' is missing",
    ),
    (
        &["while parsing a block mapping", "while parsing a block collection"],
        "this line is not indented like the others of its mapping or list",
    ),
];
