//! The coordinates that loads follow, at one position: values of the curves over them, and the
//! directions in which they move.
//!
//! A motion is integrated from one [station](super::stations) to the next. Between them each curve stays on
//! one piece, and each coordinate moves in one direction for a given sense of the driver. Both are fixed
//! there, so that the equation of motion is smooth, ends included.

use super::kinematics::SolvedPose;
use super::measure::{Measure, Over};
use super::tables::table::Cell;
use super::value::Numbers;

/// The objects that loads follow: curves over coordinates, and coordinates whose direction counts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Followed<'m> {
    pub over: &'m [Over],
    pub ways: &'m [Measure],
}

/// Curves and directions at a position.
#[derive(Debug, Clone, Default)]
pub(crate) struct Followers {
    over: Vec<[f64; 2]>,
    ways: Vec<f64>,
}

/// The pieces of curves, and the directions while the driver moves forward, that hold between two
/// stations.
#[derive(Debug, Clone, Default)]
pub(crate) struct Held {
    cells: Vec<Option<Cell>>,
    ways: Vec<f64>,
}

impl Followers {
    /// Reads a single position; `speed`: of the drivers, or their sense.
    pub(crate) fn read(
        &mut self,
        followed: Followed<'_>,
        pose: &SolvedPose<'_>,
        q: &[f64],
        speed: &[f64],
    ) {
        self.read_curves(followed, pose, q, &[]);
        self.ways.clear();
        self.ways.extend(followed.ways.iter().map(|way| way.direction(pose, speed)));
    }

    /// Reads a position between stations of a machine with one driver that moves in this sense.
    pub(crate) fn read_held(
        &mut self,
        followed: Followed<'_>,
        pose: &SolvedPose<'_>,
        q: &[f64],
        (held, sense): (&Held, f64),
    ) {
        self.read_curves(followed, pose, q, &held.cells);
        self.ways.clear();
        // At rest, without a sense, loads that follow a direction do not act.
        self.ways.extend(held.ways.iter().map(|way| way * sense));
    }

    fn read_curves(
        &mut self,
        followed: Followed<'_>,
        pose: &SolvedPose<'_>,
        q: &[f64],
        cells: &[Option<Cell>],
    ) {
        self.over.clear();
        for (index, over) in followed.over.iter().enumerate() {
            let cell = cells.get(index).copied().flatten();
            let [value, slope] = over.read(over.measure.at(pose, q), cell);
            self.over.push([value, slope * over.measure.rate(pose, 0)]);
        }
    }

    /// The numbers that loads read, without those of tables over the driver and of callbacks.
    pub(crate) fn numbers(&self) -> Numbers<'_> {
        Numbers { over: &self.over, ways: &self.ways, ..Numbers::default() }
    }
}

impl Held {
    /// Fixes the pieces and directions of a position.
    ///
    /// # Errors
    ///
    /// Index of the curve whose table does not cover the position, and the missing value.
    pub(crate) fn hold(
        &mut self,
        followed: Followed<'_>,
        pose: &SolvedPose<'_>,
        q: &[f64],
    ) -> Result<(), (usize, f64)> {
        self.cells.clear();
        for (index, over) in followed.over.iter().enumerate() {
            let at = over.measure.at(pose, q);
            self.cells.push(match over.table() {
                Some(table) => Some(table.cell(at).ok_or((index, at))?),
                None => None,
            });
        }
        self.ways.clear();
        self.ways.extend(followed.ways.iter().map(|way| way.direction(pose, &[1.0])));
        Ok(())
    }
}
