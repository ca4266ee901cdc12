//! Friction in the pairs of machines.

use assur::Mechanism;
use assur::dynamics::Friction;
use pyo3::prelude::*;

use crate::error_map;

/// `assur.JointFriction` or `assur.SlideFriction`.
#[derive(FromPyObject)]
pub(crate) enum PairFriction {
    Joint { coefficient: f64, radius: f64, viscous: f64, static_coefficient: Option<f64> },
    Slide { coefficient: f64, length: f64, viscous: f64, static_coefficient: Option<f64> },
}

impl PairFriction {
    pub(crate) fn of_pair(&self, mechanism: &Mechanism, name: &str) -> PyResult<Friction> {
        match *self {
            Self::Joint { coefficient, radius, viscous, static_coefficient } => {
                let joint = mechanism.joint(name).map_err(error_map::solve)?;
                let at_rest = static_coefficient.unwrap_or(coefficient);
                Ok(Friction::Joint {
                    joint,
                    circle: coefficient * radius,
                    static_circle: at_rest * radius,
                    viscous,
                })
            }
            Self::Slide { coefficient, length, viscous, static_coefficient } => {
                let slide = mechanism.slide(name).map_err(error_map::solve)?;
                let static_coefficient = static_coefficient.unwrap_or(coefficient);
                Ok(Friction::Slide { slide, coefficient, static_coefficient, length, viscous })
            }
        }
    }
}
