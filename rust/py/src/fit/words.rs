//! Words of a fit.

use assur::{Aim, Freedom};

use crate::convert::word::Words;

/// What a target reads.
#[derive(Debug, Clone, Copy)]
pub(super) enum Where {
    Joint,
    Angle,
    Origin,
    Slide,
}

impl Words for Where {
    const WHAT: &'static str = "kind";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("joint", Self::Joint),
        ("angle", Self::Angle),
        ("origin", Self::Origin),
        ("slide", Self::Slide),
    ];
}

/// When a target is met.
#[derive(Debug, Clone, Copy)]
pub(super) enum When {
    Fixed,
    Phase,
    Ordered,
    Free,
}

impl Words for When {
    const WHAT: &'static str = "timing";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("fixed", Self::Fixed),
        ("phase", Self::Phase),
        ("ordered", Self::Ordered),
        ("free", Self::Free),
    ];
}

impl Words for Freedom {
    const WHAT: &'static str = "freedom";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("none", Self::None),
        ("place", Self::Place),
        ("similarity", Self::Similarity),
        ("turned", Self::Turned),
        ("scale", Self::Line { scale: true, offset: false }),
        ("offset", Self::Line { scale: false, offset: true }),
        ("scale and offset", Self::Line { scale: true, offset: true }),
    ];
}

/// What a metric is to be.
#[derive(Debug, Clone, Copy)]
pub(super) enum AimWord {
    AtMost,
    AtLeast,
    Near,
}

impl AimWord {
    pub(super) fn of(self, value: f64) -> Aim {
        match self {
            Self::AtMost => Aim::AtMost(value),
            Self::AtLeast => Aim::AtLeast(value),
            Self::Near => Aim::Near(value),
        }
    }
}

impl Words for AimWord {
    const WHAT: &'static str = "aim";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("at most", Self::AtMost), ("at least", Self::AtLeast), ("near", Self::Near)];
}
