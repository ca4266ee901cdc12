//! The central slider-crank of the papers: exact motion, cosine series, continued fraction.
//!
//! Lengths are relative to the crank; λ = crank/rod, k = 1/λ > 1. φ is the crank angle from the
//! outer dead point and δ the rod angle (sin δ = λ sin φ). The stroke is measured from the outer
//! dead point. O. M. Chernysh and others, Analytical studies of the kinematic parameters of planar
//! lever mechanisms (2021), equations 1 to 42; R. V. Ambarcumyanc and M. I. Subbotina, Concerning
//! the research of kinematics of central crank gear and slider mechanism (2017), equations 1 to 11.
//!
//! # Examples
//!
//! Half a turn gives a stroke of two cranks. For a rod of three cranks, the second approximant of
//! the fraction is accurate to 0.013 %.
//!
//! ```
//! use assur::papers::slider_crank::{Quantity, deviation, stroke};
//!
//! assert!((stroke(std::f64::consts::PI, 1.0 / 3.0).0[0] - 2.0).abs() < 1e-15);
//! let relative = deviation(1.0 / 3.0, 2, Quantity::Stroke).relative.expect("of the stroke");
//! assert!((100.0 * relative.value - 0.013217).abs() < 1e-6);
//! ```

pub(crate) mod deviation;
pub(crate) mod double_double;
pub(crate) mod exact;
pub(crate) mod fraction;
pub(crate) mod greatest;
pub(crate) mod jet;
pub(crate) mod series;

pub use deviation::{Deviation, Quantity, deviation};
pub use exact::{rod_angle, rod_point, stroke};
pub use fraction::stroke_by_fraction;
pub use greatest::{Greatest, greatest_acceleration, greatest_speed, greatest_speed_by_series};
pub use jet::Jet;
pub use series::{Series, SeriesError};
