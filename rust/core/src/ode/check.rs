//! What a run refuses before it begins.

use super::error::Error;
use super::options::{LEAST_RELATIVE, Options, Output};

impl Options<'_> {
    /// Refuses what makes no sense, naming it.
    pub(super) fn check<E>(&self, t: f64, t_end: f64, y: &[f64], n: usize) -> Result<(), Error<E>> {
        if y.len() != n || n == 0 {
            return Err(Error::Dimension { expected: n, given: y.len() });
        }
        if !(t_end - t).is_finite() {
            return Err(Error::Span { from: t, to: t_end });
        }
        if let Some((component, &value)) = y.iter().enumerate().find(|(_, y)| !y.is_finite()) {
            return Err(Error::Start { component, value });
        }
        for tolerances in [self.relative, self.absolute] {
            if tolerances.len() != 1 && tolerances.len() != n {
                return Err(Error::Dimension { expected: n, given: tolerances.len() });
            }
        }
        for component in 0..n {
            // Of one for all, the first.
            let of = |list: &[f64]| list.get(component).or(list.first()).copied().unwrap_or(0.0);
            let (relative, absolute) = (of(self.relative), of(self.absolute));
            let held = (LEAST_RELATIVE..1.0).contains(&relative);
            if !(absolute >= 0.0 && (held || relative == 0.0 && absolute > 0.0)) {
                return Err(Error::Tolerance { component, relative, absolute });
            }
        }
        for value in [Some(self.max_step), self.first_step].into_iter().flatten() {
            if value.is_nan() || value <= 0.0 {
                return Err(Error::Width { value });
            }
        }
        if self.max_change.len() > n {
            return Err(Error::Dimension { expected: n, given: self.max_change.len() });
        }
        if let Some(&value) = self.max_change.iter().find(|value| value.is_nan() || **value <= 0.0)
        {
            return Err(Error::Width { value });
        }
        if let Some(index) = disorder(self.breaks, 1.0) {
            return Err(Error::Breaks { index });
        }
        let Output::At(places) = self.keep else { return Ok(()) };
        let way = if t_end < t { -1.0 } else { 1.0 };
        let inside = |&at: &f64| (at - t) * way >= 0.0 && (t_end - at) * way >= 0.0;
        let outside = places.iter().position(|at| !inside(at));
        match outside.or_else(|| disorder(places, way)) {
            Some(index) => Err(Error::Places { index }),
            None => Ok(()),
        }
    }
}

/// The first number that is NaN or not beyond the one before it.
fn disorder(list: &[f64], way: f64) -> Option<usize> {
    let nan = list.iter().position(|t| t.is_nan());
    nan.or_else(|| list.windows(2).position(|w| (w[1] - w[0]) * way < 0.0).map(|i| i + 1))
}
