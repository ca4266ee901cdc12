//! Enums given by a word.

use assur::Named;
use assur::dynamics::{EndCondition, Mean};
use assur::ode::{Crossing, Method};
use assur::sweep::{Fitted, Operation, PathDistance, Relation, Shape};
use pyo3::Borrowed;
use pyo3::prelude::*;

use crate::error;

/// An enum with a word for each variant.
pub(crate) trait Words: Copy + 'static {
    /// The choice that the word makes, for the message.
    const WHAT: &'static str;
    const KNOWN: &'static [(&'static str, Self)];
}

/// A variant, read from its word. Raises `InputError` if the word is unknown.
pub(crate) struct Word<T>(pub(crate) T);

impl<'a, 'py, T: Words> FromPyObject<'a, 'py> for Word<T> {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let text = object.extract::<String>().ok();
        let variant = T::KNOWN.iter().find(|(word, _)| text.as_deref() == Some(word));
        let refuse = || -> PyResult<PyErr> {
            let words: Vec<_> = T::KNOWN.iter().map(|(word, _)| format!("'{word}'")).collect();
            let (text, words) = (object.repr()?, words.join(", "));
            Ok(error::input(&format!("{} is {text}: one of {words} is needed", T::WHAT), None))
        };
        variant.map(|&(_, case)| Self(case)).ok_or_else(|| refuse().unwrap_or_else(|error| error))
    }
}

impl Words for EndCondition {
    const WHAT: &'static str = "spline";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("pchip", Self::Pchip),
        ("not-a-knot", Self::NotAKnot),
        ("natural", Self::Natural),
        ("clamped", Self::Clamped),
        ("periodic", Self::Periodic),
        ("linear", Self::Linear),
    ];
}

impl Words for Mean {
    const WHAT: &'static str = "mean";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("extremes", Self::Extremes), ("period", Self::Period)];
}

impl Words for Crossing {
    const WHAT: &'static str = "direction";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("either", Self::Either), ("rising", Self::Rising), ("falling", Self::Falling)];
}

impl Words for Method {
    const WHAT: &'static str = "method";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("DOP853", Self::DormandPrince853), ("RK45", Self::DormandPrince54)];
}

/// The parts of a mechanism that outputs name.
impl Words for Named {
    const WHAT: &'static str = "kind";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("joint", Self::Joint), ("link", Self::Link), ("slide", Self::Slide)];
}

impl Words for Relation {
    const WHAT: &'static str = "relation";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("<", Self::Less), ("<=", Self::AtMost), (">", Self::Greater), (">=", Self::AtLeast)];
}

impl Words for Shape {
    const WHAT: &'static str = "shape";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("line", Self::Line), ("circle", Self::Circle)];
}

impl Words for PathDistance {
    const WHAT: &'static str = "kind";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("points", Self::Points), ("chamfer", Self::Chamfer), ("ordered", Self::Ordered)];
}

impl Words for Fitted {
    const WHAT: &'static str = "fitted";
    const KNOWN: &'static [(&'static str, Self)] = &[
        ("nothing", Self::Nothing),
        ("offset", Self::Offset),
        ("scale and offset", Self::ScaleAndOffset),
    ];
}

impl Words for Operation {
    const WHAT: &'static str = "operation";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("+", Self::Add), ("-", Self::Subtract), ("*", Self::Multiply), ("/", Self::Divide)];
}
