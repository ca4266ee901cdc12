//! Checks of the arguments of a run.

use super::error::Error;
use super::options::{LEAST_RELATIVE, Options, Output};

impl Options<'_> {
    /// Returns an error that names the first invalid argument.
    pub(super) fn check<E>(&self, t: f64, t_end: f64, y: &[f64], n: usize) -> Result<(), Error<E>> {
        if y.len() != n || n == 0 {
            return Err(Error::Dimension { expected: n, given: y.len() });
        }
        if !(t_end - t).is_finite() {
            return Err(Error::Span { from: t, to: t_end });
        }
        if let Some((component, &value)) = y.iter().enumerate().find(|(_, y)| !y.is_finite()) {
            return Err(Error::InitialState { component, value });
        }
        for tolerances in [self.relative, self.absolute] {
            if tolerances.len() != 1 && tolerances.len() != n {
                return Err(Error::Dimension { expected: n, given: tolerances.len() });
            }
        }
        for component in 0..n {
            // A list of one holds for all components.
            let for_component =
                |list: &[f64]| list.get(component).or(list.first()).copied().unwrap_or(0.0);
            let (relative, absolute) = (for_component(self.relative), for_component(self.absolute));
            let in_range = (LEAST_RELATIVE..1.0).contains(&relative);
            if !(absolute >= 0.0 && (in_range || relative == 0.0 && absolute > 0.0)) {
                return Err(Error::Tolerance { component, relative, absolute });
            }
        }
        for value in [Some(self.max_step), self.first_step].into_iter().flatten() {
            if value.is_nan() || value <= 0.0 {
                return Err(Error::StepWidth { value });
            }
        }
        if self.max_change.len() > n {
            return Err(Error::Dimension { expected: n, given: self.max_change.len() });
        }
        if let Some(&value) = self.max_change.iter().find(|value| value.is_nan() || **value <= 0.0)
        {
            return Err(Error::StepWidth { value });
        }
        if let Some(index) = first_disorder(self.breaks, 1.0) {
            return Err(Error::Breaks { index });
        }
        let Output::At(times) = self.output else { return Ok(()) };
        let direction = if t_end < t { -1.0 } else { 1.0 };
        let inside = |&at: &f64| (at - t) * direction >= 0.0 && (t_end - at) * direction >= 0.0;
        let outside = times.iter().position(|at| !inside(at));
        match outside.or_else(|| first_disorder(times, direction)) {
            Some(index) => Err(Error::OutputTimes { index }),
            None => Ok(()),
        }
    }
}

/// Index of the first number that is NaN or behind the one before it.
fn first_disorder(list: &[f64], direction: f64) -> Option<usize> {
    let nan = list.iter().position(|t| t.is_nan());
    nan.or_else(|| list.windows(2).position(|w| (w[1] - w[0]) * direction < 0.0).map(|i| i + 1))
}
