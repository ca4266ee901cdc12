//! Why a run ended, for Python, copies and pickles.

use assur::dynamics::StopReason;
use pyo3::prelude::*;

use crate::error;

/// The kind of an end, and what belongs to it; the rest is `None`.
#[derive(FromPyObject, IntoPyObject, Debug, Clone, PartialEq, Default)]
#[pyo3(from_item_all)]
pub(crate) struct StopReasonState {
    kind: String,
    /// Index of the event.
    event: Option<usize>,
    /// Index of the table over the coordinate.
    table: Option<usize>,
    /// Index of the motor whose table ends.
    motor: Option<usize>,
    /// Whether the equation is stiff where the steps ran out.
    stiff: Option<bool>,
    /// Why the branch is lost.
    why: Option<String>,
    near_change_point: Option<NearChangePoint>,
    /// The cylinder whose length is 0.
    slide: Option<String>,
}

/// A near miss of a change point: the dyad, by how much its lengths miss (m), and the coordinate.
#[derive(FromPyObject, IntoPyObject, Debug, Clone, PartialEq)]
#[pyo3(from_item_all)]
pub(crate) struct NearChangePoint {
    dyad: String,
    miss: f64,
    q: f64,
}

impl From<StopReason> for StopReasonState {
    fn from(reason: StopReason) -> Self {
        let of = |kind: &str| Self { kind: kind.into(), ..Self::default() };
        match reason {
            StopReason::Reached => of("reached"),
            StopReason::Event(event) => Self { event: Some(event), ..of("event") },
            StopReason::Rest => of("rest"),
            StopReason::DeadPoint => of("dead point"),
            StopReason::Locked => of("locked"),
            StopReason::Lost(why) => Self { why: Some(why), ..of("lost") },
            StopReason::NearChangePoint { dyad, miss, q } => {
                let near_change_point = Some(NearChangePoint { dyad, miss, q });
                Self { near_change_point, ..of("near_change_point") }
            }
            StopReason::ZeroLength(slide) => Self { slide: Some(slide), ..of("zero length") },
            StopReason::TableEnds(table) => Self { table: Some(table), ..of("table ends") },
            StopReason::MotorTableEnds(motor) => {
                Self { motor: Some(motor), ..of("motor table ends") }
            }
            StopReason::StepLimit(stiff) => Self { stiff: Some(stiff), ..of("step limit") },
            StopReason::TimeLimit => of("time limit"),
            StopReason::Cancelled => of("cancelled"),
            _ => of("stalled"),
        }
    }
}

impl StopReasonState {
    /// The reason. Raises `InputError` for anything that is not the state of one.
    pub(crate) fn reason(self) -> PyResult<StopReason> {
        let known = self.known().filter(|reason| Self::from(reason.clone()) == self);
        known.ok_or_else(|| error::input(&format!("{:?} is not an end of a run", self.kind), None))
    }

    fn known(&self) -> Option<StopReason> {
        Some(match self.kind.as_str() {
            "reached" => StopReason::Reached,
            "event" => StopReason::Event(self.event?),
            "rest" => StopReason::Rest,
            "dead point" => StopReason::DeadPoint,
            "locked" => StopReason::Locked,
            "lost" => StopReason::Lost(self.why.clone()?),
            "near_change_point" => {
                let NearChangePoint { dyad, miss, q } = self.near_change_point.clone()?;
                StopReason::NearChangePoint { dyad, miss, q }
            }
            "zero length" => StopReason::ZeroLength(self.slide.clone()?),
            "table ends" => StopReason::TableEnds(self.table?),
            "motor table ends" => StopReason::MotorTableEnds(self.motor?),
            "stalled" => StopReason::Stalled,
            "step limit" => StopReason::StepLimit(self.stiff?),
            "time limit" => StopReason::TimeLimit,
            "cancelled" => StopReason::Cancelled,
            _ => return None,
        })
    }
}
