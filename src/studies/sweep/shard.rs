//! A shard: the part of a study that one task runs, independent of the others.

use std::str::FromStr;

/// Shard `index` of `count`: every `count`-th point, beginning with point `index`. Neighbouring points cost about the
/// same, so interleaving balances the shards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    /// Counted from 0.
    pub index: usize,
    /// Number of shards, at least 1.
    pub count: usize,
}

impl Shard {
    /// The whole study.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Returns the points of this shard among the first `points`, in order.
    pub fn points(self, points: usize) -> impl ExactSizeIterator<Item = usize> + Send + use<> {
        (self.index..points).step_by(self.count)
    }

    /// Whether a point belongs to this shard.
    pub fn holds(self, point: usize) -> bool {
        point % self.count == self.index
    }
}

impl std::fmt::Display for Shard {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse().ok();
        let halves = text.split_once('/');
        match halves.and_then(|(index, count)| Some((number(index)?, number(count)?))) {
            Some((index, count)) if index < count => Ok(Self { index, count }),
            Some((_, count)) if count > 0 => Err(format!(
                "shards count from 0, so the last of {count} is {}/{count}",
                count - 1
            )),
            _ => Err("a shard is INDEX/COUNT, counted from 0, as in 3/16".into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_is_in_exactly_one_shard() {
        let mut found: Vec<usize> = (0..7)
            .flat_map(|index| Shard { index, count: 7 }.points(100))
            .collect();
        found.sort_unstable();
        assert_eq!(found, (0..100).collect::<Vec<_>>());
        let shard = Shard { index: 3, count: 7 };
        assert!(
            shard
                .points(100)
                .all(|point| point % shard.count == shard.index)
        );
    }

    #[test]
    fn shards_are_written_as_they_are_read() {
        assert_eq!(
            "3/16".parse::<Shard>().map(|s| s.to_string()),
            Ok("3/16".into())
        );
        for wrong in ["", "3", "16/16", "0/0", "-1/4", "a/4", "1/4/2"] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong:?}");
        }
    }
}
