//! Why a run ended, for copies and pickles.

use assur::dynamics::StopReason;
use pyo3::prelude::*;

use crate::error;

/// The kind; an index, a name or text and numbers if it has them.
#[derive(FromPyObject, IntoPyObject, Default)]
#[pyo3(from_item_all)]
pub(crate) struct StopReasonState {
    kind: String,
    index: usize,
    name: String,
    numbers: Vec<f64>,
}

impl From<StopReason> for StopReasonState {
    fn from(reason: StopReason) -> Self {
        let plain = |kind: &str| Self { kind: kind.into(), ..Self::default() };
        let indexed = |kind: &str, index: usize| Self { index, ..plain(kind) };
        match reason {
            StopReason::Reached => plain("reached"),
            StopReason::Event(event) => indexed("event", event),
            StopReason::Rest => plain("rest"),
            StopReason::DeadPoint => plain("dead point"),
            StopReason::Lost(why) => Self { name: why, ..plain("lost") },
            StopReason::NearChangePoint { dyad, miss, q } => {
                Self { name: dyad, numbers: vec![miss, q], ..plain("near_change_point") }
            }
            StopReason::TableEnds(table) => indexed("table ends", table),
            StopReason::MotorTableEnds(motor) => indexed("motor table ends", motor),
            StopReason::StepLimit(stiff) => indexed("step limit", usize::from(stiff)),
            StopReason::TimeLimit => plain("time limit"),
            StopReason::Cancelled => plain("cancelled"),
            _ => plain("stalled"),
        }
    }
}

impl StopReasonState {
    /// Kind, index, and name or text.
    pub(crate) fn described(self) -> (String, usize, String) {
        (self.kind, self.index, self.name)
    }

    /// The reason. Raises `InputError` for an unknown kind.
    pub(crate) fn reason(self) -> PyResult<StopReason> {
        let Self { kind, index, name, numbers } = self;
        Ok(match (kind.as_str(), &numbers[..]) {
            ("reached", []) => StopReason::Reached,
            ("event", []) => StopReason::Event(index),
            ("rest", []) => StopReason::Rest,
            ("dead point", []) => StopReason::DeadPoint,
            ("lost", []) => StopReason::Lost(name),
            ("near_change_point", &[miss, q]) => {
                StopReason::NearChangePoint { dyad: name, miss, q }
            }
            ("table ends", []) => StopReason::TableEnds(index),
            ("motor table ends", []) => StopReason::MotorTableEnds(index),
            ("stalled", []) => StopReason::Stalled,
            ("step limit", []) => StopReason::StepLimit(index != 0),
            ("time limit", []) => StopReason::TimeLimit,
            ("cancelled", []) => StopReason::Cancelled,
            _ => return Err(error::input(&format!("{kind:?} is not an end of a run"), None)),
        })
    }
}
