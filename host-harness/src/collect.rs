//! Puts together what the stream splits over several frames.

use flat_wire::message::Point;

/// Collects the shares of one whole, bodies or contacts.
#[derive(Debug)]
pub struct Collector<T> {
    at: Option<Point>,
    items: Vec<T>,
}

impl<T: Copy> Collector<T> {
    /// Nothing collected yet.
    pub fn new() -> Self {
        Self { at: None, items: Vec::new() }
    }

    /// Takes one frame's share; returns the whole once it is complete. A share of another point starts afresh.
    pub fn push(&mut self, at: Point, total: u16, share: &[T]) -> Option<Vec<T>> {
        if self.at != Some(at) {
            self.at = Some(at);
            self.items.clear();
        }
        self.items.extend_from_slice(share);
        if self.items.len() < usize::from(total) {
            return None;
        }
        self.at = None;
        Some(std::mem::take(&mut self.items))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_is_complete_at_its_last_share_and_a_lost_share_spoils_only_its_own_point() {
        let at = |step| Point { step, stage: 5 };
        let mut collector = Collector::new();
        assert_eq!(collector.push(at(1), 3, &[1, 2]), None);
        assert_eq!(collector.push(at(2), 3, &[4, 5]), None, "step 1 lost its end");
        assert_eq!(collector.push(at(2), 3, &[6]), Some(vec![4, 5, 6]));
        assert_eq!(collector.push(at(3), 0, &[]), Some(vec![]));
    }
}
