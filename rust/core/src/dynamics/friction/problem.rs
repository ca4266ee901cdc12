//! Coulomb friction at one position: the sliding pairs, and how every reaction depends on the friction.
//!
//! At given speeds and accelerations reactions are linear in the loads, friction among them. So with
//! the friction τ of all pairs (moments on links at pins, forces along guides) each pair's reaction is
//! R = R₀ + A τ, and the law of friction says τ = −s c(R), with s the sense of the sliding and c ≥ 0
//! homogeneous in R.

use std::sync::atomic::{AtomicBool, Ordering};

use nalgebra::{DMatrix, DVector};

/// The law of friction of a pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Law {
    /// A journal in a bearing: moment ρ |F|, with ρ the radius of the friction circle. R is the force F.
    Journal { circle: f64 },
    /// A link on a guide that it touches over a length L, at both ends: force f (|N/2 − M/L| +
    /// |N/2 + M/L|) = f max(|N|, 2 |M|/L). R is the normal force N and the moment M.
    Guide { coefficient: f64, half_length: f64 },
}

impl Law {
    /// Size of the friction.
    pub(super) fn size(self, [x, y]: [f64; 2]) -> f64 {
        match self {
            Self::Journal { circle } => circle * (x * x + y * y).sqrt(),
            Self::Guide { coefficient, half_length } => {
                coefficient * x.abs().max(y.abs() / half_length)
            }
        }
    }

    /// The slope of the size by the first and second number of R; at a kink the slope on one side.
    fn slope(self, [x, y]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Journal { circle } => {
                let size = (x * x + y * y).sqrt();
                if size > 0.0 { [circle * x / size, circle * y / size] } else { [0.0; 2] }
            }
            Self::Guide { coefficient, half_length } if x.abs() >= y.abs() / half_length => {
                [coefficient.copysign(x), 0.0]
            }
            Self::Guide { coefficient, half_length } => {
                [0.0, (coefficient / half_length).copysign(y)]
            }
        }
    }

    /// The index of the linear form that gives the size: a law is smooth within a face, and has a kink where
    /// it enters another one.
    fn face(self, [x, y]: [f64; 2]) -> u8 {
        match self {
            Self::Journal { .. } => 0,
            Self::Guide { half_length, .. } if x.abs() >= y.abs() / half_length => {
                u8::from(x > 0.0)
            }
            Self::Guide { .. } => 2 + u8::from(y > 0.0),
        }
    }

    /// The law if moments are divided by a unit of length.
    fn in_forces(self, unit: f64) -> Self {
        match self {
            Self::Journal { circle } => Self::Journal { circle: circle / unit },
            Self::Guide { coefficient, half_length } => {
                Self::Guide { coefficient, half_length: half_length / unit }
            }
        }
    }

    /// The unit of its friction if moments are divided by a unit of length: that of a moment or of a force.
    pub(super) fn unit(self, length: f64) -> f64 {
        match self {
            Self::Journal { .. } => length,
            Self::Guide { .. } => 1.0,
        }
    }

    /// The forms, linear in R; the size is the greatest of them.
    pub(super) fn faces(self) -> Vec<[f64; 2]> {
        match self {
            Self::Journal { .. } => Vec::new(),
            Self::Guide { coefficient, half_length } => {
                let tilted = coefficient / half_length;
                vec![[coefficient, 0.0], [-coefficient, 0.0], [0.0, tilted], [0.0, -tilted]]
            }
        }
    }
}

/// A pair with friction at a position.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SlidingPair {
    pub law: Law,
    /// +1 or −1.
    pub sense: f64,
    /// Speed of sliding, rad/s or m/s: 0 or more.
    pub rate: f64,
    /// Its reaction without friction.
    pub base: [f64; 2],
    /// The part of the reaction from the friction of every pair, per unit.
    pub slopes: Vec<[f64; 2]>,
}

impl SlidingPair {
    /// Whether its reaction is known.
    pub(crate) fn is_finite(&self) -> bool {
        let finite = |numbers: &[f64; 2]| numbers.iter().all(|number| number.is_finite());
        finite(&self.base) && self.slopes.iter().all(finite)
    }
}

/// All pairs with friction that slide at a position.
#[derive(Debug, Clone, Default)]
pub(crate) struct FrictionProblem<'c> {
    pub pairs: Vec<SlidingPair>,
    /// Set to true when the caller no longer needs the solutions: some take half a second.
    pub cancel: Option<&'c AtomicBool>,
}

impl FrictionProblem<'_> {
    /// The problem with all moments divided by a unit of length, so that frictions, and what is small beside
    /// them, compare as forces.
    pub(super) fn in_forces(mut self, unit: f64) -> Self {
        let units: Vec<f64> = self.pairs.iter().map(|pair| pair.law.unit(unit)).collect();
        for (pair, pair_unit) in self.pairs.iter_mut().zip(&units) {
            // The second number of R is a force at a pin, a moment at a guide.
            let second = match pair.law {
                Law::Journal { .. } => 1.0,
                Law::Guide { .. } => unit,
            };
            pair.law = pair.law.in_forces(unit);
            pair.rate *= pair_unit;
            pair.base[1] /= second;
            for (slope, by) in pair.slopes.iter_mut().zip(&units) {
                *slope = [slope[0] * by, slope[1] * by / second];
            }
        }
        self
    }

    /// Whether the caller has cancelled the work.
    pub(crate) fn is_cancelled(&self) -> bool {
        self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    /// The reaction of a pair.
    pub(super) fn reaction(&self, pair: usize, friction: &[f64]) -> [f64; 2] {
        let SlidingPair { base, slopes, .. } = &self.pairs[pair];
        let mut sum = *base;
        for (slope, &friction) in slopes.iter().zip(friction) {
            sum[0] += slope[0] * friction;
            sum[1] += slope[1] * friction;
        }
        sum
    }

    /// Whether the laws of all pairs are in the same face with two frictions.
    pub(super) fn is_same_face(&self, a: &[f64], b: &[f64]) -> bool {
        (0..self.pairs.len()).all(|pair| {
            let law = self.pairs[pair].law;
            law.face(self.reaction(pair, a)) == law.face(self.reaction(pair, b))
        })
    }

    /// The residuals of the law if all coefficients are multiplied by `scale`.
    pub(super) fn residual(&self, friction: &[f64], scale: f64) -> DVector<f64> {
        DVector::from_fn(self.pairs.len(), |row, _| {
            let pair = &self.pairs[row];
            friction[row] + scale * pair.sense * pair.law.size(self.reaction(row, friction))
        })
    }

    /// The greatest residual of the law, relative to the greatest friction.
    pub(crate) fn missed(&self, friction: &[f64]) -> f64 {
        let greatest = friction.iter().fold(0.0_f64, |most, friction| most.max(friction.abs()));
        if greatest == 0.0 { 0.0 } else { self.residual(friction, 1.0).amax() / greatest }
    }

    /// The slopes of the residual by the friction.
    pub(super) fn jacobian(&self, friction: &[f64], scale: f64) -> DMatrix<f64> {
        let n = self.pairs.len();
        let mut matrix = DMatrix::identity(n, n);
        for (row, pair) in self.pairs.iter().enumerate() {
            let [x, y] = pair.law.slope(self.reaction(row, friction));
            for (column, slope) in pair.slopes.iter().enumerate() {
                matrix[(row, column)] += scale * pair.sense * (x * slope[0] + y * slope[1]);
            }
        }
        matrix
    }

    /// The size with which friction is compared: that without any feedback.
    pub(super) fn size(&self) -> f64 {
        self.pairs.iter().map(|pair| pair.law.size(pair.base)).fold(0.0, f64::max)
    }

    /// Whether the solution is certainly unique, because a change of the friction changes it by less than
    /// itself.
    ///
    /// With B ≥ 0 the bounds of those changes the law is a contraction in a weighted norm if B has a
    /// spectral radius below 1, which it has if (I − B) y = 1 has a positive solution y (A. Berman and
    /// R. J. Plemmons, *Nonnegative Matrices in the Mathematical Sciences*, 1994, ch. 6).
    pub(super) fn is_contraction(&self) -> bool {
        let n = self.pairs.len();
        let matrix = DMatrix::from_fn(n, n, |row, column| {
            let pair = &self.pairs[row];
            let bound = pair.law.size(pair.slopes[column]);
            if row == column { 1.0 - bound } else { -bound }
        });
        matrix
            .lu()
            .solve(&DVector::from_element(n, 1.0))
            .is_some_and(|y| y.iter().all(|&y| y > 0.0 && y < MOST_FEEDBACK))
    }
}

/// Above this the spectral radius is 1 to rounding.
const MOST_FEEDBACK: f64 = 1.0e6;
