//! One design, one position after another: what a motion in time asks for.

use super::design::{Design, Units};
use super::state::{State, Status};
use super::track::nearest;
use crate::mechanism::Mechanism;
use crate::plan::Plan;
use crate::plan::bind::Bound;
use crate::plan::jet::Jets;

/// A mechanism of one design with its way laid, and work space for a position.
pub(crate) struct Follower<'m> {
    design: Design<'m>,
    state: State,
    near: Vec<f64>,
    q: Vec<f64>,
}

/// A position just solved.
#[derive(Clone, Copy)]
pub(crate) struct Position<'p> {
    pub state: &'p State,
    pub plan: &'p Plan,
    pub bound: &'p Bound,
    pub units: &'p Units,
    q: &'p [f64],
    near: &'p [f64],
    whole: &'p [f64],
}

impl<'m> Follower<'m> {
    /// Binds dimensions and lays the way along some coordinates (all that will be asked for, of
    /// a slide).
    pub(crate) fn new(
        mechanism: &'m Mechanism,
        dimensions: &[f64],
        signs: &[i8],
        jets: &'m Jets,
        q: &[f64],
    ) -> Self {
        let mut design = Design::new(mechanism, signs, jets);
        design.bind(dimensions);
        design.lay_way(q);
        let state = design.state(jets);
        Self { design, state, near: Vec::new(), q: Vec::new() }
    }

    /// Solves at a coordinate (rad or m, of every driver).
    ///
    /// # Errors
    ///
    /// The status of a place that has no position, or no analogues.
    pub(crate) fn solve(&mut self, q: &[f64]) -> Result<Position<'_>, Status> {
        self.q.clear();
        self.q.extend(self.design.scaled(q));
        let place = self.design.way(&self.q);
        let solved = self.design.solve(&mut self.state, &self.q, place.as_ref());
        let Some(place) = place.filter(|_| solved) else { return Err(self.state.status) };
        self.near = self.design.near(&place, self.state.class.len());
        Ok(Position {
            state: &self.state,
            plan: self.design.mechanism.plan(),
            bound: &self.design.bound,
            units: &self.design.unit,
            q: &self.q,
            near: &self.near,
            whole: &self.design.mechanism.whole_turns,
        })
    }
}

impl Position<'_> {
    /// Angle of a link, rad, continuous along the way.
    pub(crate) fn angle(&self, link: usize) -> f64 {
        let rotation = &self.plan.rotation[link];
        let class = self.state.class[rotation.class][0].angle();
        let mut angle = nearest(class, self.near[rotation.class]);
        for (&turns, q) in rotation.turns.iter().zip(self.q) {
            angle += f64::from(turns) * q;
        }
        angle + self.bound.offset[link] + std::f64::consts::TAU * self.whole[link]
    }
}
