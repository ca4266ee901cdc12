//! Where the joints of a passive cylinder coincide: its length has a kink there, and its angle steps by
//! half a turn. No derivative shows it, so these places are looked for by themselves.

use super::curve::{ASIDE, Curve};
use super::tracked::{Tracked, ValueAt};
use super::window::Window;
use crate::math::root::bisection::{TO_ROUNDING, bisect};
use crate::plan::dyad::Unknown;

/// Greatest length there, relative to the size: the root of the rounding of its square.
const ZERO: f64 = 1.0e-7;

impl Curve<'_> {
    /// Values beside the places where the tracked coordinate is not smooth.
    pub(super) fn at_zero_lengths(&mut self, window: &Window, nodes: &[f64]) -> Vec<ValueAt> {
        let mut values = Vec::new();
        for angle in self.zero_lengths(window, nodes) {
            let q = window.at(angle);
            if self.order == 0 && matches!(self.tracked, Tracked::Slide(_)) {
                values.push(ValueAt { value: 0.0, q });
                continue;
            }
            for aside in [-ASIDE, ASIDE] {
                let beside = window.at(angle + aside);
                let Some([value, rate, _]) = self.by_coordinate(beside) else { continue };
                values.push(ValueAt { value: value + rate * (q - beside), q });
            }
        }
        values
    }

    /// The places, as angles of the window, where the cylinder has no length that is tracked or whose
    /// link is.
    pub(super) fn zero_lengths(&mut self, window: &Window, nodes: &[f64]) -> Vec<f64> {
        let Some(slide) = self.tracked_length() else { return Vec::new() };
        let mut found = Vec::new();
        let mut before: Option<(f64, f64)> = None;
        for &angle in nodes {
            let here = self.length(window, angle, slide).map(|(_, rate)| (angle, rate));
            if let (Some((from, falls)), Some((to, rises))) = (before, here)
                && falls < 0.0
                && rises > 0.0
            {
                let is_falling =
                    |at: f64| self.length(window, at, slide).map(|(_, rate)| rate < 0.0).ok_or(());
                if let Ok([at, _]) = bisect([from, to], TO_ROUNDING, is_falling)
                    && let Some((length, rate)) = self.length(window, at, slide)
                    && length < ZERO
                {
                    // Beside the place no rate is known; up to it the length falls evenly.
                    let ahead = -length / rate * self.evaluator.unit(0);
                    found.push(at + ahead / window.rates(at)[0]);
                }
            }
            // At length 0 itself it is neither.
            before = here.filter(|&(_, rate)| rate != 0.0).or(before.filter(|_| here.is_some()));
        }
        found
    }

    /// A passive length that is tracked, or with which a tracked link turns.
    fn tracked_length(&self) -> Option<usize> {
        let plan = self.evaluator.position().plan;
        let lengths = plan.dyads().filter(|dyad| dyad.is_length);
        let mut pairs = lengths.filter_map(|dyad| match dyad.unknowns {
            [Unknown::Class(class), Unknown::Slide(slide)] => Some((class, slide)),
            _ => None,
        });
        let is_tracked = |&(class, slide): &(usize, usize)| match self.tracked {
            Tracked::Slide(own) => own == slide,
            Tracked::Link(link) => plan.rotation[link].class == class,
            Tracked::Joint(..) => false,
        };
        pairs.find(is_tracked).map(|(_, slide)| slide)
    }

    /// A length in sizes, and its derivative by q; at length 0 it is neither falling nor rising.
    fn length(&mut self, window: &Window, angle: f64, slide: usize) -> Option<(f64, f64)> {
        self.evaluator.solve(&[window.at(angle)]).ok()?;
        let state = self.evaluator.position().state;
        let [value, rate] = [0, 1].map(|k| state.pose.slides[slide * state.len + k][0]);
        Some((value, if rate.is_nan() { 0.0 } else { rate }))
    }
}
