//! The linkage in its two modes: a crank-rocker, and a slider-crank while joint C is jammed.
//!
//! The paper (section 3) does not name the joint that locks. This module assumes that joint C jams where
//! the transmission angle falls to its least value. Coupler and rocker then move as one rigid rod BD, and
//! the support D slides along the line of centres until it has returned to its position.

use std::f64::consts::PI;

use libm::{acos, hypot};

use super::case::{Case, JammingError, Row, Side};
use super::motion::{Assembly, position};
use crate::math::trig::sin_cos;

/// Crank angle between samples, rad. A jam that begins and ends between two samples is found by its
/// peak.
pub(super) const SAMPLE_STEP: f64 = PI / 360.0;
/// Step of the difference quotient for the speed of the ground, as a fraction of a sample step.
const GROUND_STEP: f64 = 1.0e-3;
/// Dead point: a rod shorter by this fraction of its length would not reach the line of centres.
const DEAD_POINT_RTOL: f64 = 1.0e-12;

/// `None` as a crank-rocker, or the side while D slides.
pub(super) type Mode = Option<Side>;

/// The linkage at any time of a run.
pub(super) struct JammingLinkage<F> {
    pub case: Case,
    /// Length of the ground as a function of time.
    ground: F,
    /// Last time and value of the ground.
    cached: Option<(f64, f64)>,
}

impl<E, F: FnMut(f64) -> Result<f64, E>> JammingLinkage<F> {
    pub(super) fn new(case: Case, ground: F) -> Self {
        Self { case, ground, cached: None }
    }

    /// Prescribed distance AD.
    pub(super) fn ground(&mut self, t: f64) -> Result<f64, JammingError<E>> {
        if let Some((at, value)) = self.cached
            && at.to_bits() == t.to_bits()
        {
            return Ok(value);
        }
        let value = (self.ground)(t).map_err(JammingError::Ground)?;
        self.cached = Some((t, value));
        Ok(value)
    }

    fn ground_speed(&mut self, t: f64) -> Result<f64, JammingError<E>> {
        let h = GROUND_STEP * SAMPLE_STEP / self.case.speed.abs();
        let low = (t - h).max(0.0);
        Ok((self.ground(t + h)? - self.ground(low)?) / (t + h - low))
    }

    /// Crank angle.
    pub(super) fn phi(&self, t: f64) -> f64 {
        self.case.phi0 + self.case.speed * t
    }

    /// BD where C jams.
    fn jam_distance(&self, side: Side) -> f64 {
        let [_, l2, l3] = self.case.lengths;
        let [outer, inner] = self.case.gamma_min;
        let (sign, gamma_min) = if side == Side::Outer { (1.0, outer) } else { (-1.0, inner) };
        let product = 2.0 * l2 * l3 * sin_cos(gamma_min).1;
        (l2 * l2 + l3 * l3 + sign * product).sqrt()
    }

    /// BD of the crank-rocker, with D at its position.
    fn pin_distance(&mut self, t: f64) -> Result<f64, JammingError<E>> {
        let l4 = self.ground(t)?;
        let (sine, cosine) = sin_cos(self.phi(t));
        let l1 = self.case.lengths[0];
        Ok(hypot(l4 + l1 * cosine, l1 * sine))
    }

    /// Transmission angle for a distance BD.
    fn gamma(&self, s: f64) -> f64 {
        let [_, l2, l3] = self.case.lengths;
        let cosine = (l2 * l2 + l3 * l3 - s * s) / (2.0 * l2 * l3);
        let angle = acos(cosine.clamp(-1.0, 1.0));
        angle.min(PI - angle)
    }

    /// Distance of BD beyond the nearer jam distance, and the side.
    pub(super) fn jam_excess(&mut self, t: f64) -> Result<(f64, Side), JammingError<E>> {
        let s = self.pin_distance(t)?;
        let (outer, inner) =
            (s - self.jam_distance(Side::Outer), self.jam_distance(Side::Inner) - s);
        Ok(if outer > inner { (outer, Side::Outer) } else { (inner, Side::Inner) })
    }

    /// Distance AD while D slides; where the rod is too short, its last value.
    pub(super) fn sliding_ground(&self, t: f64, side: Side) -> f64 {
        let (sine, cosine) = sin_cos(self.phi(t));
        let (l1, rod) = (self.case.lengths[0], self.jam_distance(side));
        -l1 * cosine + ((rod - l1 * sine) * (rod + l1 * sine)).max(0.0).sqrt()
    }

    /// Displacement of D from its position, positive while it slides; −∞ where the rod is too
    /// short.
    fn displacement(&mut self, t: f64, side: Side) -> Result<f64, JammingError<E>> {
        let (sine, _) = sin_cos(self.phi(t));
        if (self.case.lengths[0] * sine).abs() > self.jam_distance(side) {
            return Ok(f64::NEG_INFINITY);
        }
        let gap = self.ground(t)? - self.sliding_ground(t, side);
        Ok(if side == Side::Outer { gap } else { -gap })
    }

    /// Event function: positive where the mode has ended.
    pub(super) fn mode_end(&mut self, t: f64, mode: Mode) -> Result<f64, JammingError<E>> {
        match mode {
            None => Ok(self.jam_excess(t)?.0),
            Some(side) => Ok(-self.displacement(t, side)?),
        }
    }

    /// Velocities of D, and of rocker or rod: each as a crank-rocker and as a slider-crank.
    pub(super) fn speeds(&mut self, t: f64, side: Side) -> Result<[[f64; 2]; 2], JammingError<E>> {
        let (phi, l4, moving) = (self.phi(t), self.ground(t)?, self.ground_speed(t)?);
        let (sine, cosine) = sin_cos(phi);
        let ([l1, l2, l3], speed) = (self.case.lengths, self.case.speed);
        let (rod, across) = (self.jam_distance(side), l1 * sine);
        let reach = (rod * rod - across * across).sqrt();
        let sliding = l1 * sine * speed * (1.0 - l1 * cosine / reach);
        let rates = |ground_speed: f64| {
            let result = position(phi, [l1, l2, l3, l4], Assembly::Printed, [speed, ground_speed]);
            result.map_or([f64::NAN; 2], |(_, rates)| [rates.of.phi3, rates.of.phi3_first])
        };
        let ([rocker, _], [_, rod]) = (rates(moving), rates(sliding));
        Ok([[moving, sliding], [rocker, rod]])
    }

    /// Why the mechanism cannot start.
    pub(super) fn start_error(&mut self, side: Side) -> Result<JammingError<E>, JammingError<E>> {
        let s = self.pin_distance(0.0)?;
        let [_, l2, l3] = self.case.lengths;
        let (range, phi0) = ([(l2 - l3).abs(), l2 + l3], self.case.phi0);
        if !(range[0] <= s && s <= range[1]) {
            return Ok(JammingError::OutOfReach { distance: s, range, phi0 });
        }
        Ok(JammingError::Blocked { side, gamma: self.gamma(s), phi0 })
    }

    /// Whether the rod just reaches the line of centres.
    pub(super) fn is_at_dead_point(&self, t: f64, side: Side) -> bool {
        let (sine, _) = sin_cos(self.phi(t));
        (self.case.lengths[0] * sine).abs() >= self.jam_distance(side) * (1.0 - DEAD_POINT_RTOL)
    }

    /// The position at a time.
    pub(super) fn row(&mut self, t: f64, mode: Mode) -> Result<Row, JammingError<E>> {
        let l4 = match mode {
            Some(side) => self.sliding_ground(t, side),
            None => self.ground(t)?,
        };
        let [l1, l2, l3] = self.case.lengths;
        let (sine, cosine) = sin_cos(self.phi(t));
        let b = [l1 * cosine, l1 * sine];
        let (along, across) = (b[0] + l4, b[1]);
        let s = mode.map_or_else(|| hypot(along, across), |side| self.jam_distance(side));
        // φ₃″, from DB to the rocker.
        let phi3_second = acos(((s * s + l3 * l3 - l2 * l2) / (2.0 * s * l3)).clamp(-1.0, 1.0));
        let (sine, cosine) = sin_cos(phi3_second);
        let ratio = l3 / hypot(along, across);
        let c = [
            ratio * (along * cosine - across * sine) - l4,
            ratio * (along * sine + across * cosine),
        ];
        let gamma = self.gamma(s);
        Ok(Row { t, l4, gamma, sliding: mode.is_some(), positions: [b, c] })
    }
}
