//! The drawings of the named mechanisms, as the arguments of `assur.Mechanism`.

use assur::{ClassIv, Description, DriverDescription, FourBar, FourBarMode, SliderCrank};
use pyo3::prelude::*;

use crate::convert::description::Slide;
use crate::convert::word::{Word, Words};

/// The arguments of `assur.Mechanism`.
#[derive(IntoPyObject)]
pub(crate) struct Drawing {
    joints: Vec<(String, [f64; 2])>,
    links: Vec<(String, Vec<String>)>,
    slides: Vec<(String, Slide)>,
    driver: Option<String>,
}

impl Words for FourBarMode {
    const WHAT: &'static str = "mode";
    const KNOWN: &'static [(&'static str, Self)] =
        &[("open", Self::Open), ("crossed", Self::Crossed)];
}

#[pyfunction]
pub(crate) fn four_bar_drawing(mode: Word<FourBarMode>) -> Drawing {
    drawing(FourBar::description(mode.0))
}

#[pyfunction]
pub(crate) fn slider_crank_drawing() -> Drawing {
    drawing(SliderCrank::description())
}

#[pyfunction]
pub(crate) fn class_iv_drawing(joints: [[f64; 2]; 10]) -> Drawing {
    drawing(ClassIv::description(joints))
}

fn drawing(description: Description) -> Drawing {
    let slides = description.slides.into_iter();
    let driver = description.drivers.into_iter().next().map(|driver| match driver {
        DriverDescription::Named(name) | DriverDescription::Relative { link: name, .. } => name,
    });
    Drawing {
        joints: description.joints,
        links: description.links,
        slides: slides.map(Slide::with_name).collect(),
        driver,
    }
}
