//! What is integrated: right-hand side, events and hooks in one place.

/// Why the right-hand side gave no rates.
#[derive(Debug, Clone, PartialEq)]
pub enum Fault<E> {
    /// There is no state here, as beyond the range of a mechanism. A smaller step is tried; the run
    /// ends at the edge of what is there.
    OutOfDomain,
    /// The run must end, and this is why.
    Error(E),
}

impl<E> From<E> for Fault<E> {
    fn from(error: E) -> Self {
        Self::Error(error)
    }
}

/// What to do after an event. Of several events at one place, the last in this list is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Action {
    /// Nothing: the event is only recorded. Neither state nor right-hand side may have changed.
    Continue,
    /// Start again from here: the state or the right-hand side is another one from now on.
    Restart,
    /// End the run here.
    Stop,
}

/// When an event function g makes an event.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crossing {
    /// From g < 0 to g ≥ 0, in the direction of the run. A run that starts on zero is not at an
    /// event.
    Rising,
    /// From g > 0 to g ≤ 0.
    Falling,
    /// Either of both.
    Either,
    /// As soon as g < 0: the right-hand side is one of a piece, which is g ≥ 0. A run or restart
    /// on zero is inside; one outside makes the event at once.
    Boundary,
}

/// A system of ordinary differential equations y' = f(t, y) with what happens on the way.
pub trait System {
    /// What else can go wrong.
    type Error;

    /// The right-hand side f. All rates must be written; NaN or infinity anywhere is refused.
    ///
    /// # Errors
    ///
    /// [`Fault`], if there are no rates here.
    fn rates(&mut self, t: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<Self::Error>>;

    /// A smooth stretch begins at `from`, in state `y`, and goes no further than `to`: the start,
    /// a break or a restart. Until the next call, `rates` must be one smooth function, at both
    /// ends too: of a table over t that has all its knots among the breaks, the piece that
    /// contains (`from` + `to`) / 2.
    ///
    /// # Errors
    ///
    /// Any error ends the run.
    fn enter(&mut self, from: f64, to: f64, y: &[f64]) -> Result<(), Self::Error> {
        let _ = (from, to, y);
        Ok(())
    }

    /// Event functions, as many as there are [`Crossing`]s in the options. NaN where there is none:
    /// nothing happens there.
    ///
    /// # Errors
    ///
    /// Any error ends the run.
    fn events(&mut self, t: f64, y: &[f64], values: &mut [f64]) -> Result<(), Self::Error> {
        let _ = (t, y);
        values.fill(f64::NAN);
        Ok(())
    }

    /// An event has happened, and is recorded. The state may be changed if the run starts again
    /// (an impact; or q set to the knot of a table that it has reached, so that it is on the
    /// border of both pieces and inside neither is a matter of rounding).
    ///
    /// # Errors
    ///
    /// Any error ends the run.
    fn on_event(&mut self, event: usize, t: f64, y: &mut [f64]) -> Result<Action, Self::Error> {
        let _ = (event, t, y);
        Ok(Action::Continue)
    }

    /// An invariant is watched from here: the right-hand side was asked last for this state.
    fn watch_invariant(&mut self, t: f64, y: &[f64]) {
        let _ = (t, y);
    }

    /// How far an invariant has moved over a step whose end is this state, for which the right-hand
    /// side was asked last: in tolerances, of which it may take one. (An estimate of the error sees
    /// a narrow feature between its stages as little as they do.)
    fn drift(&mut self, t: f64, y: &[f64]) -> f64 {
        let _ = (t, y);
        0.0
    }

    /// The step that was asked for its [`System::drift`] last was taken.
    fn keep_invariant(&mut self) {}

    /// Whether the run is to end, as after a signal or a deadline. Asked every few steps.
    fn cancelled(&mut self) -> bool {
        false
    }
}

/// A right-hand side alone, a closure, as a [`System`].
#[derive(Debug)]
pub struct Rates<F>(pub F);

impl<F, E> System for Rates<F>
where
    F: FnMut(f64, &[f64], &mut [f64]) -> Result<(), Fault<E>>,
{
    type Error = E;

    #[inline]
    fn rates(&mut self, t: f64, y: &[f64], rates: &mut [f64]) -> Result<(), Fault<E>> {
        self.0(t, y, rates)
    }
}
