//! A metric over a part of the positions.

use super::metric::{Growth, Metric, Need, Positions};
use crate::batch::outputs::Quantity;

/// A metric of the positions whose coordinate is within a range.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part<M> {
    /// The metric.
    pub metric: M,
    /// First and last coordinate, rad or m.
    pub from: f64,
    /// See `from`.
    pub to: f64,
    /// What coordinates are counted modulo: a turn, for angles.
    pub period: Option<f64>,
}

impl<M> Part<M> {
    fn contains(&self, q: f64) -> bool {
        match self.period {
            None => self.from <= q && q <= self.to,
            Some(period) => {
                let turned = (q - self.from) / period;
                (turned - turned.floor()) * period <= self.to - self.from
            }
        }
    }
}

impl<M: Metric> Metric for Part<M> {
    fn needs(&self) -> Vec<Need> {
        self.metric.needs()
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        let chosen: Vec<usize> =
            (0..positions.q.len()).filter(|&at| self.contains(positions.q[at])).collect();
        let q: Vec<f64> = chosen.iter().map(|&at| positions.q[at]).collect();
        let gather = |(values, need): (&&[f64], Need)| -> Vec<f64> {
            let width = match need.quantity {
                Quantity::Joint(_) | Quantity::Place(_) => 2,
                Quantity::Slide(_) | Quantity::Angle(_) => 1,
            };
            chosen.iter().flat_map(|&at| &values[at * width..][..width]).copied().collect()
        };
        let values: Vec<Vec<f64>> =
            positions.values.iter().zip(self.metric.needs()).map(gather).collect();
        let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        self.metric.of(&Positions { q: &q, values: &values, ..*positions })
    }

    fn growth(&self) -> Growth {
        self.metric.growth()
    }
}

impl<M: Metric + ?Sized + Send> Metric for Box<M> {
    fn needs(&self) -> Vec<Need> {
        self.as_ref().needs()
    }

    fn of(&self, positions: &Positions<'_>) -> f64 {
        self.as_ref().of(positions)
    }

    fn growth(&self) -> Growth {
        self.as_ref().growth()
    }
}
