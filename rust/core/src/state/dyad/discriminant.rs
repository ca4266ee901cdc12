//! Tools to detect change points and pass through them: the discriminant of a dyad, distances between
//! states, and interpolation of states.

use crate::math::lanes::Real;
use crate::math::tolerance::CHANGE_MISFIT;
use crate::math::vector::Vector;
use crate::plan::dyad::{Dyad, Form};
use crate::plan::plan::EdgeSlide;
use crate::state::state::{Context, State};

impl<R: Real, const G: usize> State<R, G> {
    /// Discriminant of a dyad and its derivative by one driver (jet entry `first`): the sine of the
    /// angle between its legs, or the chord of a rotation and a slide, with the sign of the
    /// assembly. It is zero where the dyad is flat; the derivative leaves out the change of the
    /// normalising lengths, whose contribution vanishes there.
    #[inline(always)]
    pub(crate) fn discriminant(
        &self,
        g: usize,
        cx: &Context<'_>,
        dyad: &Dyad,
        first: usize,
    ) -> (R, R) {
        let a = self.leg_vector(g, cx, dyad, 0, 0);
        let da = self.leg_vector(g, cx, dyad, 0, first);
        let (value, rate, size) = match dyad.form {
            Form::TwoCircles => {
                let b = self.leg_vector(g, cx, dyad, 1, 0);
                let db = self.leg_vector(g, cx, dyad, 1, first);
                (b.cross(a), db.cross(a) + b.cross(da), a.norm() * b.norm())
            }
            Form::CircleAndLine | Form::TurningGuide => {
                let guide = self.slide_direction(g, cx, dyad, 1, 0);
                let rate_of = self.slide_direction(g, cx, dyad, 1, first);
                let (value, rate) = (guide.dot(a), rate_of.dot(a) + guide.dot(da));
                if dyad.form == Form::TurningGuide {
                    (value, rate, R::ONE)
                } else {
                    (-value, -rate, a.norm())
                }
            }
            Form::TwoLines => (R::ONE, R::ZERO, R::ONE),
        };
        let inv_size = R::ONE / size;
        (value * inv_size, rate * inv_size)
    }

    /// Its sign shows which way a dyad that does not close is flat: with legs folded or stretched, on one
    /// side of its guide or the other. Between two positions at which it differs the dyad closes
    /// somewhere.
    #[inline(always)]
    pub(crate) fn flat_side(&self, g: usize, cx: &Context<'_>, dyad: &Dyad) -> R {
        let a = self.leg_vector(g, cx, dyad, 0, 0);
        match dyad.form {
            Form::TwoCircles => a.dot(self.leg_vector(g, cx, dyad, 1, 0)),
            _ => self.slide_direction(g, cx, dyad, 1, 0).cross(a),
        }
    }
}

impl State {
    /// Ratio of a dyad's greatest length or coordinate to its shortest leg, or to the scale where the
    /// discriminant is a length: the factor from rounding to an error of the discriminant.
    pub(crate) fn length_ratio(&self, cx: &Context<'_>, dyad: &Dyad) -> f64 {
        let a = self.leg_vector(0, cx, dyad, 0, 0).norm2();
        let b = match dyad.form {
            Form::TwoCircles => self.leg_vector(0, cx, dyad, 1, 0).norm2(),
            _ => a,
        };
        let unit = if dyad.form == Form::TurningGuide { 1.0 } else { a.min(b) };
        let coordinate_scale2 = self.conditions.coordinate_scale2[dyad.start][0]
            .max(self.conditions.coordinate_scale2[dyad.end][0]);
        (coordinate_scale2.max(a).max(b) / unit).sqrt()
    }

    /// Greatest closure error of any edge, relative to the scale.
    pub(crate) fn residual(&self, cx: &Context<'_>) -> f64 {
        let len = self.len;
        (cx.plan.edges.iter().zip(&cx.constants.edge_vector).zip(&cx.constants.guide))
            .map(|((e, &edge_vector), &guide)| {
                let mut span = edge_vector;
                if let EdgeSlide::Slide(s) | EdgeSlide::Driver { slide: s } = e.along {
                    span += guide.scale(self.pose.slides[s * len][0]);
                }
                let orientation = &cx.plan.orientations[e.orientation];
                let rotation = self.pose.class[orientation.class][0];
                let driven = orientation.driven;
                let turned =
                    if driven { rotation * self.pose.phase[e.orientation][0] } else { rotation }
                        * span;
                let misfit = self.pose.points[e.edge.to * len][0]
                    - self.pose.points[e.edge.from * len][0]
                    - turned;
                let norm = misfit.norm();
                // The square may overflow where the components do not.
                if norm == f64::INFINITY { misfit.x.abs().max(misfit.y.abs()) } else { norm }
            })
            // Unlike `max`, this takes a NaN; only a later finite value replaces it.
            .fold(0.0, |most, misfit| if misfit <= most { most } else { misfit })
    }

    /// Whether the points agree with those of another state, within its accuracy.
    pub(crate) fn is_near(&self, other: &Self) -> bool {
        let allowed = CHANGE_MISFIT * other.conditions.greatest[0].sqrt();
        let values =
            |state: &Self| state.pose.points.iter().step_by(state.len).map(|p| p[0]).collect();
        let (a, b): (Vec<Vector>, Vec<Vector>) = (values(self), values(other));
        a.iter().zip(&b).all(|(&a, &b)| (a - b).norm() <= allowed)
    }

    /// Greatest distance of the points' analogues of an order (one driver; 0: the points) from
    /// those of another state, relative to the scale or to themselves.
    pub(crate) fn distance(&self, other: &Self, order: usize) -> f64 {
        let relative =
            |(a, b): (&[Vector; 1], &[Vector; 1])| (a[0] - b[0]).norm() / (1.0 + b[0].norm());
        let pairs = self.pose.points.iter().zip(&other.pose.points).skip(order).step_by(self.len);
        let pairs = pairs.take(if order < self.len { usize::MAX } else { 0 });
        // Unlike `max`, this takes a NaN; only a later finite value replaces it.
        pairs.map(relative).fold(0.0, |most, misfit| if misfit <= most { most } else { misfit })
    }

    /// Sets the state to a weighted sum of other states of the same plan: a polynomial through
    /// them, evaluated between them.
    pub(crate) fn interpolate(&mut self, states: &[Self], weights: &[f64]) {
        fn sum(
            out: &mut [[f64; 1]],
            states: &[State],
            weights: &[f64],
            values_of: impl Fn(&State) -> &[[f64; 1]],
        ) {
            for (i, x) in out.iter_mut().enumerate() {
                x[0] = states.iter().zip(weights).map(|(s, w)| w * values_of(s)[i][0]).sum();
            }
        }
        fn sums(
            out: &mut [[Vector; 1]],
            states: &[State],
            weights: &[f64],
            values_of: impl Fn(&State) -> &[[Vector; 1]],
        ) {
            for (i, x) in out.iter_mut().enumerate() {
                x[0] = Vector::ZERO;
                for (s, &w) in states.iter().zip(weights) {
                    x[0] += values_of(s)[i][0].scale(w);
                }
            }
        }
        sums(&mut self.pose.points, states, weights, |s| &s.pose.points);
        sums(&mut self.pose.orient, states, weights, |s| &s.pose.orient);
        sums(&mut self.pose.phase, states, weights, |s| &s.pose.phase);
        sums(&mut self.pose.class, states, weights, |s| &s.pose.class);
        sum(&mut self.pose.theta, states, weights, |s| &s.pose.theta);
        sum(&mut self.pose.slides, states, weights, |s| &s.pose.slides);
    }
}
