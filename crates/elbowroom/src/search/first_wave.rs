//! D*'s first wave from the goals: with nothing to raise, buckets take the place of the comparison heap.

use super::ring::Ring;
use super::{Dstar, Graph};

impl Dstar {
    /// Before the first expansion, if the graph tells how wide buckets should be.
    pub(super) fn begin_wave<G: Graph>(&mut self, graph: &G) {
        if self.expansions == 0 && self.ring.is_none() {
            self.ring = graph.usual_step().and_then(Ring::new);
        }
    }

    /// What still waits in buckets goes to the heap, where raising is possible.
    pub(super) fn end_wave(&mut self) {
        let Some(mut ring) = self.ring.take() else { return };
        for node in ring.drain() {
            if self.open.is_in_ring(node) {
                self.open.insert(node, self.nodes.cost(node));
            }
        }
    }

    /// The first bucket with anything in it: goals that wait for their turn, and what lies beyond the ring, are in the heap.
    pub(super) fn first_bucket(&self, ring: &Ring) -> Option<u64> {
        let far = self.open.least_key().map(|key| ring.bucket_of(key));
        [ring.first(), far].into_iter().flatten().min()
    }

    /// Expands nodes of the first bucket, `most` of them at most; how many.
    pub(super) fn expand_bucket<G: Graph>(&mut self, graph: &G, most: usize) -> usize {
        let Some(mut ring) = self.ring.take() else { return 0 };
        let mut expanded = 0;
        if let Some(bucket) = self.first_bucket(&ring) {
            ring.go_on_to(bucket);
            self.fetch(&mut ring, bucket);
            while expanded < most
                && let Some(node) = ring.pop()
            {
                // Others were lowered since, and wait where they belong or are done with.
                if self.open.is_in_ring(node) && ring.bucket_of(self.nodes.cost(node)) == bucket {
                    self.open.leave_ring(node);
                    self.spread_in_wave(graph, node, &mut ring);
                    expanded += 1;
                }
            }
        }
        self.expansions += expanded;
        self.ring = Some(ring);
        expanded
    }

    /// Moves what belongs into `bucket` from the heap to the ring.
    fn fetch(&mut self, ring: &mut Ring, bucket: u64) {
        while self.open.least_key().is_some_and(|key| ring.bucket_of(key) == bucket)
            && let Some((node, _)) = self.open.pop()
        {
            // A goal whose cost was raised before anybody knew of it is further on than its key.
            let cost = self.nodes.cost(node);
            if ring.push(ring.bucket_of(cost), node) {
                self.open.enter_ring(node);
            } else {
                self.open.insert(node, cost);
            }
        }
    }

    /// LOWER, where nothing was ever raised. Of equal ways the one by the node that a heap would have expanded first is
    /// kept, so that the pointers do not depend on the queue.
    #[inline]
    fn spread_in_wave<G: Graph>(&mut self, graph: &G, node: usize, ring: &mut Ring) {
        let cost = self.nodes.cost(node);
        graph.neighbours(node, |neighbour, step| {
            let (known, through) = (self.nodes.cost(neighbour), cost + step);
            if through > known {
                return;
            }
            if through < known {
                self.nodes.set_cost(neighbour, through);
                self.nodes.set_next(neighbour, node);
                self.wait(neighbour, (known, through), ring);
            } else if through < f64::INFINITY
                && let Some(next) = self.nodes.next(neighbour)
                && (cost, node) < (self.nodes.cost(next), next)
            {
                self.nodes.set_next(neighbour, node);
            }
        });
    }

    /// Queues `node`, whose cost fell from `known` to `cost`, unless it waits in the right bucket already.
    #[inline]
    fn wait(&mut self, node: usize, (known, cost): (f64, f64), ring: &mut Ring) {
        let bucket = ring.bucket_of(cost);
        if self.open.is_in_ring(node) && bucket == ring.bucket_of(known) {
            return;
        }
        if !self.open.is_in_heap(node) && ring.push(bucket, node) {
            self.open.enter_ring(node);
        } else {
            self.open.insert(node, cost);
        }
    }
}
