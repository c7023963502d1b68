/// Children of one entry of the heap: four of them fit one cache line.
const ARITY: usize = 4;

/// The slot of a node that is not on the list: 0, so that a new list is memory nobody has touched.
const ABSENT: u32 = 0;

/// For how many nodes there is room at first.
const LEAST_ROOM: usize = 64;

/// The slot of a node that waits in a [`Ring`](super::ring::Ring).
const IN_RING: u32 = 1;

/// Slots of nodes in the heap are their places in it plus this.
const FIRST: u32 = 2;

/// D*'s open list: nodes waiting to be expanded, the one of least key first, of equal keys the least node.
///
/// A 4-ary heap that knows where each node stands in it, so that a node is on the list once at most and its key
/// can be lowered in place.
#[derive(Debug, Clone)]
pub(super) struct OpenList {
    heap: Vec<Entry>,
    slots: Vec<u32>,
}

/// The bits of a key above the number of its node. Keys are never negative, so their bits sort as they do.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Entry(u128);

impl Entry {
    fn new(node: usize, key: f64) -> Self {
        debug_assert!(key >= 0.0 && key.is_sign_positive());
        Self((u128::from(key.to_bits()) << 64) | node as u128)
    }

    fn node(self) -> usize {
        self.0 as usize
    }

    fn key(self) -> f64 {
        f64::from_bits((self.0 >> 64) as u64)
    }
}

impl OpenList {
    /// An empty list for nodes below `len`.
    pub(super) fn new(len: usize) -> Self {
        Self { heap: Vec::new(), slots: vec![ABSENT; len] }
    }

    /// Takes everything off.
    pub(super) fn clear(&mut self) {
        self.heap.clear();
        self.slots.fill(ABSENT);
    }

    /// Whether `node` is on the list, or in the ring.
    pub(super) fn contains(&self, node: usize) -> bool {
        self.slots[node] != ABSENT
    }

    /// Whether `node` waits in the ring.
    #[inline]
    pub(super) fn is_in_ring(&self, node: usize) -> bool {
        self.slots[node] == IN_RING
    }

    /// Whether `node` is in the heap.
    #[inline]
    pub(super) fn is_in_heap(&self, node: usize) -> bool {
        self.slots[node] >= FIRST
    }

    /// Keeps in mind that `node`, which is not in the heap, waits in the ring.
    #[inline]
    pub(super) fn enter_ring(&mut self, node: usize) {
        self.slots[node] = IN_RING;
    }

    /// Keeps in mind that `node` has left the ring.
    #[inline]
    pub(super) fn leave_ring(&mut self, node: usize) {
        self.slots[node] = ABSENT;
    }

    /// For how many nodes the heap has room: never more than there are.
    pub(super) fn room(&self) -> usize {
        self.heap.capacity()
    }

    /// The least key in the heap.
    pub(super) fn least_key(&self) -> Option<f64> {
        self.heap.first().map(|entry| entry.key())
    }

    /// Puts `node` into the heap with `key`, or lowers the key it has there; a key is never raised.
    pub(super) fn insert(&mut self, node: usize, key: f64) {
        let entry = Entry::new(node, key);
        match self.slots[node].checked_sub(FIRST) {
            None => {
                let waiting = self.heap.len();
                if waiting == self.heap.capacity() {
                    self.heap.reserve_exact(waiting.max(LEAST_ROOM).min(self.slots.len() - waiting));
                }
                self.heap.push(entry);
                self.sift_up(self.heap.len() - 1, entry);
            }
            Some(slot) if entry < self.heap[slot as usize] => self.sift_up(slot as usize, entry),
            Some(_) => {}
        }
    }

    /// Takes the first node out of the heap, with its key.
    pub(super) fn pop(&mut self) -> Option<(usize, f64)> {
        let first = *self.heap.first()?;
        let last = self.heap.pop()?;
        if !self.heap.is_empty() {
            self.fill_root(last);
        }
        self.slots[first.node()] = ABSENT;
        Some((first.node(), first.key()))
    }

    /// Moves `entry` from `slot` towards the root to where it belongs.
    fn sift_up(&mut self, mut slot: usize, entry: Entry) {
        while slot > 0 {
            let parent = (slot - 1) / ARITY;
            if self.heap[parent] < entry {
                break;
            }
            self.place(slot, self.heap[parent]);
            slot = parent;
        }
        self.place(slot, entry);
    }

    /// Fills the root's place: the least children move up, all the way, and `entry` goes where a leaf is missing.
    ///
    /// An entry from the end of the heap mostly belongs down there again, so it is not compared on the way.
    fn fill_root(&mut self, entry: Entry) {
        let mut slot = 0;
        loop {
            let first = slot * ARITY + 1;
            let least = match self.heap.get(first..self.heap.len().min(first + ARITY)) {
                // Without branches, which could not be predicted.
                Some(&[a, b, c, d]) => {
                    let (left, right) = (usize::from(b < a), 2 + usize::from(d < c));
                    first + if d.min(c) < b.min(a) { right } else { left }
                }
                Some(rest) if !rest.is_empty() => {
                    (1..rest.len()).fold(first, |l, i| if rest[i] < self.heap[l] { first + i } else { l })
                }
                _ => break,
            };
            self.place(slot, self.heap[least]);
            slot = least;
        }
        self.sift_up(slot, entry);
    }

    fn place(&mut self, slot: usize, entry: Entry) {
        self.heap[slot] = entry;
        self.slots[entry.node()] = slot as u32 + FIRST;
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use rand_chacha::ChaCha8Rng;
    use rand_core::{Rng, SeedableRng};

    use super::OpenList;

    #[test]
    fn agrees_with_a_sorted_map() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let mut below = |n: u64| rng.next_u64() % n;
        for case in 0..2_000 {
            let len = 1 + case % 40;
            let mut list = OpenList::new(len);
            let mut judge = BTreeMap::new();
            for _ in 0..200 {
                if below(3) > 0 {
                    // Few distinct keys, so that ties abound.
                    let (node, key) = (below(len as u64) as usize, below(8) as f64 / 4.0);
                    list.insert(node, key);
                    let known = judge.entry(node).or_insert(key);
                    *known = known.min(key);
                } else {
                    let first = judge.iter().map(|(&n, &k)| (n, k)).min_by(|a, b| a.1.total_cmp(&b.1));
                    assert_eq!(list.least_key(), first.map(|(_, key)| key));
                    assert_eq!(list.pop(), first);
                    if let Some((node, _)) = first {
                        judge.remove(&node);
                    }
                }
                assert!((0..len).all(|node| list.contains(node) == judge.contains_key(&node)));
            }
        }
    }
}
