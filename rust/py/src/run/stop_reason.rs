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

/// A near miss of a change point: the dyad, the miss of its lengths (m), and the coordinate.
#[derive(FromPyObject, IntoPyObject, Debug, Clone, PartialEq)]
#[pyo3(from_item_all)]
pub(crate) struct NearChangePoint {
    dyad: String,
    miss: f64,
    q: f64,
}

impl From<StopReason> for StopReasonState {
    fn from(reason: StopReason) -> Self {
        let kind = Self { kind: kind_of(&reason).into(), ..Self::default() };
        match reason {
            StopReason::Event(event) => Self { event: Some(event), ..kind },
            StopReason::Lost(why) => Self { why: Some(why), ..kind },
            StopReason::NearChangePoint { dyad, miss, q } => {
                Self { near_change_point: Some(NearChangePoint { dyad, miss, q }), ..kind }
            }
            StopReason::ZeroLength(slide) => Self { slide: Some(slide), ..kind },
            StopReason::TableEnds(table) => Self { table: Some(table), ..kind },
            StopReason::MotorTableEnds(motor) => Self { motor: Some(motor), ..kind },
            StopReason::StepLimit(stiff) => Self { stiff: Some(stiff), ..kind },
            _ => kind,
        }
    }
}

/// The kind of an end, as Python names it.
pub(super) fn kind_of(reason: &StopReason) -> &'static str {
    match reason {
        StopReason::Reached => "reached",
        StopReason::Event(_) => "event",
        StopReason::Rest => "rest",
        StopReason::DeadPoint => "dead point",
        StopReason::Locked => "locked",
        StopReason::Lost(_) => "lost",
        StopReason::NearChangePoint { .. } => "near_change_point",
        StopReason::ZeroLength(_) => "zero length",
        StopReason::TableEnds(_) => "table ends",
        StopReason::MotorTableEnds(_) => "motor table ends",
        StopReason::StepLimit(_) => "step limit",
        StopReason::TimeLimit => "time limit",
        StopReason::Cancelled => "cancelled",
        _ => "stalled",
    }
}

impl StopReasonState {
    /// The reason. Raises `InputError` for anything that is not the state of one.
    pub(crate) fn reason(self) -> PyResult<StopReason> {
        let reason = self.known().filter(|reason| Self::from(reason.clone()) == self);
        reason.ok_or_else(|| error::input(&format!("{:?} is not an end of a run", self.kind), None))
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
