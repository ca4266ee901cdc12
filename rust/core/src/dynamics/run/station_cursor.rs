//! The stations around the coordinate of a motion in time, found as the motion goes on.

use super::table_cursor::same_within;

/// Part of a turn (or of the size) that is searched at a time.
const CHUNK: f64 = std::f64::consts::TAU;

/// Stations found so far.
#[derive(Debug, Clone, Default)]
pub(crate) struct StationCursor {
    stations: Vec<f64>,
    /// The range that has been searched, once a motion has begun.
    range: Option<[f64; 2]>,
}

impl StationCursor {
    /// Whether a motion in time has begun.
    pub(crate) fn has_begun(&self) -> bool {
        self.range.is_some()
    }

    /// The interval between stations around a coordinate, or ahead of it (`up`) where it is at a
    /// station; it contains the coordinate. `search` finds the stations of a range; `unit` is that of
    /// the coordinate.
    pub(crate) fn around(
        &mut self,
        q: f64,
        up: bool,
        unit: f64,
        mut search: impl FnMut([f64; 2]) -> Vec<f64>,
    ) -> [f64; 2] {
        let (near, chunk) = (same_within(q, unit), CHUNK * unit);
        let [mut from, mut to] = self.range.unwrap_or([q, q]);
        while to <= q + near {
            self.stations.extend(search([to, to + chunk]));
            to += chunk;
        }
        while from >= q - near {
            self.stations.splice(0..0, search([from - chunk, from]));
            from -= chunk;
        }
        self.range = Some([from, to]);
        let ahead = if up { q + near } else { q - near };
        let after = if up {
            self.stations.partition_point(|&station| station <= ahead)
        } else {
            self.stations.partition_point(|&station| station < ahead)
        };
        let low = after.checked_sub(1).map_or(from, |index| self.stations[index]);
        let high = self.stations.get(after).copied().unwrap_or(to);
        [low.min(q), high.max(q)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_lie_ahead() {
        let mut cursor = StationCursor::default();
        let search = |range: [f64; 2]| {
            (-20..20).map(f64::from).filter(|s| (range[0]..range[1]).contains(s)).collect()
        };
        assert_eq!(cursor.around(0.5, true, 1.0, search), [0.0, 1.0]);
        assert_eq!(cursor.around(1.0, true, 1.0, search), [1.0, 2.0]);
        assert_eq!(cursor.around(1.0, false, 1.0, search), [0.0, 1.0]);
        assert_eq!(cursor.around(-9.5, false, 1.0, search), [-10.0, -9.0]);
        assert_eq!(cursor.around(9.0 + 1e-13, true, 1.0, search), [9.0, 10.0]);
        assert_eq!(cursor.around(9.0 - 1e-13, true, 1.0, search), [9.0 - 1e-13, 10.0]);
    }
}
