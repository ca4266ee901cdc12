//! The states of the environments underway.

use super::turns::Turns;

/// Arrays over the environments underway, in their order, drivers fastest.
#[derive(Debug, Default)]
pub(super) struct States {
    /// At the start of the attempted step.
    pub q: Vec<f64>,
    pub speed: Vec<f64>,
    /// At the stage that is found next.
    pub stage_q: Vec<f64>,
    pub stage_speed: Vec<f64>,
    /// Rates of coordinates and speeds at every stage.
    pub rates: Vec<[Vec<f64>; 2]>,
    /// Absolute tolerances of speeds.
    pub speed_tolerance: Vec<f64>,
    /// Efforts, or one for all.
    pub effort: Vec<f64>,
    /// Values of the numbers that vary, one an environment.
    pub varied: Vec<Vec<f64>>,
    /// Widths of the attempted steps.
    pub h: Vec<f64>,
    /// Statuses of the attempted steps.
    pub status: Vec<u8>,
    /// What the stages of the attempted steps show of drivers that turn back.
    pub turns: Turns,
    /// Mean squares of the error estimates of a unit step, in tolerances.
    pub fine: Vec<f64>,
    pub coarse: Vec<f64>,
}

impl States {
    /// Begins with the states of some environments, for methods of some stages.
    pub(super) fn start(&mut self, [q, speed]: [&[f64]; 2], stages: usize, n: usize) {
        for (array, values) in [
            (&mut self.q, q),
            (&mut self.speed, speed),
            (&mut self.stage_q, q),
            (&mut self.stage_speed, speed),
            (&mut self.speed_tolerance, speed),
        ] {
            array.clear();
            array.extend_from_slice(values);
        }
        self.rates.resize_with(stages, Default::default);
        self.fit(q.len() / n, n);
    }

    /// Makes room for the attempted steps of some environments, at the start of which no status is known.
    pub(super) fn fit(&mut self, count: usize, n: usize) {
        let rates = self.rates.iter_mut().flatten();
        let stage = [&mut self.stage_q, &mut self.stage_speed];
        for array in rates.chain(stage) {
            array.resize(count * n, 0.0);
        }
        for array in [&mut self.h, &mut self.fine, &mut self.coarse] {
            array.resize(count, 0.0);
        }
        self.status.clear();
        self.status.resize(count, 0);
        self.turns.start(count, n);
    }

    /// Goes on from the end of the attempted step of one environment.
    pub(super) fn accept(&mut self, index: usize, n: usize) {
        let range = index * n..(index + 1) * n;
        self.q[range.clone()].copy_from_slice(&self.stage_q[range.clone()]);
        self.speed[range.clone()].copy_from_slice(&self.stage_speed[range.clone()]);
        // The rates at the end are those at the start of the next step.
        if let [first, .., end] = &mut self.rates[..] {
            for (first, end) in first.iter_mut().zip(end) {
                first[range.clone()].copy_from_slice(&end[range.clone()]);
            }
        }
    }

    /// Keeps the environments of some indices, which ascend.
    pub(super) fn keep(&mut self, kept: &[usize], n: usize) {
        let rates = self.rates.iter_mut().take(1).flatten();
        let states = [&mut self.q, &mut self.speed, &mut self.speed_tolerance];
        for array in states.into_iter().chain(rates) {
            keep(array, kept, n);
        }
        if self.effort.len() > n {
            keep(&mut self.effort, kept, n);
        }
        for array in self.varied.iter_mut().chain([&mut self.h]) {
            keep(array, kept, 1);
        }
        self.fit(kept.len(), n);
    }
}

/// Keeps rows of numbers.
fn keep(array: &mut Vec<f64>, kept: &[usize], width: usize) {
    for (place, &index) in kept.iter().enumerate() {
        array.copy_within(index * width..(index + 1) * width, place * width);
    }
    array.truncate(kept.len() * width);
}
