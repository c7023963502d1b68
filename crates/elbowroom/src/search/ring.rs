/// Steps that are longer than this many widths are for another queue.
const BUCKETS: u64 = 64;

/// Added to 2^52 a number keeps its whole part alone, in its lowest bits.
const ROUNDER: f64 = 4_503_599_627_370_496.0;

/// A queue without comparisons: nodes wait in buckets, by how many whole widths there are in their key.
///
/// Entries can be pushed for the bucket that is being emptied and the [`BUCKETS`] from it on. Where no step is shorter than
/// a width nothing falls into the bucket that is being emptied, so its order does not matter.
///
/// # Reference
/// Denardo and Fox, "Shortest-route methods: 1. Reaching, pruning, and buckets", *Operations Research* 27(1) (1979).
#[derive(Debug, Clone)]
pub(super) struct Ring {
    per_width: f64,
    buckets: Vec<Vec<u32>>,
    /// The number of the bucket that is being emptied.
    current: u64,
    /// What is left of it, from `next` on; what came later is in its bucket.
    emptied: Vec<u32>,
    next: usize,
}

impl Ring {
    /// An empty queue with buckets of `width`; `None` for a width that cannot be divided by.
    pub(super) fn new(width: f64) -> Option<Self> {
        // Rounding must not put a step of exactly one width into the same bucket.
        let per_width = (1.0 + 1e-9) / width;
        (per_width.is_finite() && per_width > 0.0).then(|| Self {
            per_width,
            buckets: vec![Vec::new(); BUCKETS as usize],
            current: 0,
            emptied: Vec::new(),
            next: 0,
        })
    }

    /// The number of the bucket for `key`: as widths are added it goes up by ones, from wherever it begins.
    #[inline]
    pub(super) fn bucket_of(&self, key: f64) -> u64 {
        // Quicker than a conversion, and it cannot overflow: the bits of great numbers still sort as they do.
        (key * self.per_width + ROUNDER).to_bits()
    }

    /// Puts `node` into `bucket`, if there is room for it: not before the current bucket or too far behind it.
    #[inline]
    pub(super) fn push(&mut self, bucket: u64, node: usize) -> bool {
        let has_room = bucket.wrapping_sub(self.current) < BUCKETS;
        if has_room {
            self.buckets[(bucket % BUCKETS) as usize].push(node as u32);
        }
        has_room
    }

    /// Takes a node out of the current bucket, the one that waits there longest.
    #[inline]
    pub(super) fn pop(&mut self) -> Option<usize> {
        if self.next == self.emptied.len() {
            self.emptied.clear();
            self.next = 0;
            std::mem::swap(&mut self.emptied, &mut self.buckets[(self.current % BUCKETS) as usize]);
        }
        let node = *self.emptied.get(self.next)?;
        self.next += 1;
        Some(node as usize)
    }

    /// The number of the first bucket that is not empty.
    pub(super) fn first(&self) -> Option<u64> {
        if self.next < self.emptied.len() {
            return Some(self.current);
        }
        (self.current..self.current.saturating_add(BUCKETS))
            .find(|bucket| !self.buckets[(bucket % BUCKETS) as usize].is_empty())
    }

    /// How many entries wait.
    pub(super) fn len(&self) -> usize {
        self.emptied.len() - self.next + self.buckets.iter().map(Vec::len).sum::<usize>()
    }

    /// Goes on to `bucket`, before which there must be nothing.
    pub(super) fn go_on_to(&mut self, bucket: u64) {
        debug_assert!(bucket >= self.current && self.first().is_none_or(|first| bucket <= first));
        self.current = bucket;
    }

    /// All entries, in no order of their keys; the queue is empty then.
    pub(super) fn drain(&mut self) -> impl Iterator<Item = usize> {
        let next = std::mem::take(&mut self.next);
        let emptied = self.emptied.drain(..).skip(next);
        emptied.chain(self.buckets.iter_mut().flat_map(|bucket| bucket.drain(..))).map(|node| node as usize)
    }
}
