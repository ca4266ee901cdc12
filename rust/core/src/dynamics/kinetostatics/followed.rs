//! The curves over other coordinates, and the directions in which these move, at some positions of one
//! design.

use crate::dynamics::machine::Machine;
use crate::dynamics::measure::{Measure, sign};
use crate::dynamics::reactions::columns::{Solved, Sources};
use crate::math::lanes::place_in_blocks;

/// Values of the loads that follow other coordinates, each at every position.
#[derive(Debug, Clone, Default)]
pub(super) struct Followed {
    pub over: Vec<Vec<f64>>,
    pub ways: Vec<Vec<f64>>,
}

/// The drivers: their coordinates, the size of each unit, and in which sense they are about to move
/// where all rest.
#[derive(Clone, Copy)]
pub(super) struct Drivers<'d> {
    pub q: &'d [f64],
    pub units: &'d [f64],
    pub sense: &'d [f64],
}

impl Followed {
    /// Reads solved positions.
    pub(super) fn read(
        &mut self,
        machine: &Machine,
        sources: &Sources,
        solved: &Solved<'_>,
        drivers: Drivers<'_>,
        size: f64,
    ) {
        let n = drivers.units.len();
        self.over.resize(machine.over.len(), Vec::new());
        for (values, over) in self.over.iter_mut().zip(&machine.over) {
            values.clear();
            let at = |row: usize| match over.measure {
                Measure::Driver(driver) => drivers.q[row * n + driver],
                measure => column(sources, measure).map_or(0.0, |c| solved.columns[c][row]),
            };
            values.extend((0..solved.positions).map(|row| over.read(at(row), None)[0]));
        }
        self.ways.resize(machine.ways.len(), Vec::new());
        for (values, &way) in self.ways.iter_mut().zip(&machine.ways) {
            values.clear();
            let unit = if matches!(way, Measure::Slide(_)) { size } else { 1.0 };
            values.extend((0..solved.positions).map(|row| {
                let speeds = drivers.speeds(solved.speed, row);
                let (mut rate, mut fastest) = (0.0, 0.0);
                for (driver, speed) in speeds.iter().enumerate() {
                    rate += speed * derivative(sources, way, solved, [row, driver, n]);
                    fastest += (speed / drivers.units[driver]).abs();
                }
                sign(rate, fastest * unit)
            }));
        }
    }
}

impl<'d> Drivers<'d> {
    /// The speeds at a position; where all rest, the sense.
    fn speeds(self, all: &'d [f64], row: usize) -> &'d [f64] {
        let n = self.units.len();
        let drivers = if all.len() == n { all } else { &all[row * n..(row + 1) * n] };
        if drivers.iter().all(|&speed| speed == 0.0) { self.sense } else { drivers }
    }
}

/// The column of a coordinate's values.
fn column(sources: &Sources, measure: Measure) -> Option<usize> {
    match measure {
        Measure::Driver(_) => None,
        Measure::Slide(slide) => sources.slides[slide],
        Measure::Angle(link) => sources.angles[link],
    }
}

fn derivative(
    sources: &Sources,
    measure: Measure,
    solved: &Solved<'_>,
    [row, driver, n]: [usize; 3],
) -> f64 {
    match measure {
        Measure::Driver(followed) => f64::from(followed == driver),
        // The column of the first derivatives follows.
        _ => column(sources, measure)
            .map_or(0.0, |c| solved.columns[c + 1][place_in_blocks(row, n, driver)]),
    }
}
