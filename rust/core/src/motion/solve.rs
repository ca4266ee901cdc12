//! From a request (designs, coordinates, wanted outputs) to arrays.

use super::design::{Design, Units};
use super::state::{Context, State, Status};
use super::track::Track as Way;
use crate::error::SolveError;
use crate::mechanism::Mechanism;
use crate::plan::jet::Jets;
use crate::structure::closure::point_of_joint;

/// Where the coordinates are taken from; `drivers` numbers a position.
#[derive(Debug, Clone, Copy)]
pub enum Coordinates<'a> {
    /// The same positions for every design.
    Shared(&'a [f64]),
    /// Positions of every design, one design after another.
    PerDesign(&'a [f64]),
}

impl<'a> Coordinates<'a> {
    /// The `count` numbers of one design.
    pub(crate) fn of(self, design: usize, count: usize) -> &'a [f64] {
        match self {
            Self::Shared(q) => q,
            Self::PerDesign(q) => &q[design * count..][..count],
        }
    }
}

/// What is kept: indices of joints, links and slides.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Outputs {
    /// Joints.
    pub joints: Vec<usize>,
    /// Links (angle, and place of the reference point).
    pub links: Vec<usize>,
    /// Slides.
    pub slides: Vec<usize>,
}

impl Outputs {
    /// Everything a mechanism has.
    #[must_use]
    pub fn all(mechanism: &Mechanism) -> Self {
        let linkage = mechanism.linkage();
        Self {
            joints: (0..linkage.joints.len()).collect(),
            links: (0..linkage.links.len()).collect(),
            slides: (0..linkage.slides.len()).collect(),
        }
    }
}

/// What to solve.
#[derive(Debug, Clone)]
pub struct Request<'a> {
    /// Dimensions, one design after another.
    pub dimensions: &'a [f64],
    /// Coordinates, rad or m.
    pub coordinates: Coordinates<'a>,
    /// Assembly signs, +1 or −1 for every dyad with two solutions.
    pub signs: &'a [i8],
    /// Highest order of the analogues, 0 to 3.
    pub order: usize,
    /// What to keep.
    pub outputs: &'a Outputs,
}

/// Value and analogues of one quantity over all designs and positions.
///
/// `derivatives[k]` is of order k (0: the value). Entries run over designs,
/// positions, components (2 for a point) and k driver indices, last fastest.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Track {
    /// Index of the joint, link or slide.
    pub index: usize,
    /// Arrays by order.
    pub derivatives: Vec<Vec<f64>>,
}

/// The motion of a batch of designs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Motion {
    /// Number of designs.
    pub designs: usize,
    /// Positions of each design.
    pub positions: usize,
    /// Joints' places, m.
    pub joints: Vec<Track>,
    /// Links' angles, rad.
    pub links: Vec<Track>,
    /// Places of the links' reference points (first joint), m.
    pub places: Vec<Track>,
    /// Slides' values, m.
    pub slides: Vec<Track>,
    /// One [`Status`] code a position.
    pub status: Vec<u8>,
}

/// Solves a request; see [`Mechanism::solve`].
///
/// # Errors
///
/// Those of [`Mechanism::solve`].
pub fn solve(mechanism: &Mechanism, request: &Request<'_>) -> Result<Motion, SolveError> {
    mechanism.require_closed_form()?;
    let shape = Shape::of(mechanism, request)?;
    let jets = Jets::new(shape.drivers, request.order);
    let layout = Layout::new(&jets);
    let mut motion = empty(&shape, request, &layout);
    let signs: Vec<f64> = request.signs.iter().map(|&s| f64::from(s)).collect();
    for design in 0..shape.designs {
        let values = &request.dimensions[design * shape.dimensions..][..shape.dimensions];
        if mechanism.dimensions().first_fault(values).is_some() {
            let rows = design * shape.positions..(design + 1) * shape.positions;
            motion.status[rows].fill(Status::BadDimension as u8);
            continue;
        }
        let q = request.coordinates.of(design, shape.positions * shape.drivers);
        solve_design(
            &Design::new(mechanism, values, &signs, &jets, q),
            (&jets, &layout, q),
            &mut motion,
            design * shape.positions,
        );
    }
    Ok(motion)
}

/// All positions of one design, into the rows from `first` on.
fn solve_design(
    design: &Design<'_>,
    (jets, layout, q): (&Jets, &Layout, &[f64]),
    motion: &mut Motion,
    first: usize,
) {
    let mut state = design.state(jets);
    let cx = design.context(jets);
    for (position, q) in design.scaled(q).chunks_exact(design.unit.coordinate.len()).enumerate() {
        let row = first + position;
        let place = design.way(q);
        let analogues = design.solve(&mut state, q, place.as_ref());
        motion.status[row] = state.status as u8;
        let solved = matches!(state.status, Status::Ok | Status::NearSingular | Status::Singular);
        if let (true, Some(place)) = (solved, &place) {
            let write = Write {
                mechanism: design.mechanism,
                cx: &cx,
                state: &state,
                unit: &design.unit,
                layout,
                row,
                analogues,
            };
            write.all(motion, &design.angles(place), place.at, q);
        }
    }
}

struct Shape {
    designs: usize,
    positions: usize,
    drivers: usize,
    dimensions: usize,
}

impl Shape {
    fn of(mechanism: &Mechanism, request: &Request<'_>) -> Result<Self, SolveError> {
        if request.order > 3 {
            return Err(SolveError::Order(request.order));
        }
        let (dimensions, drivers) = (mechanism.dimensions().len(), mechanism.q0().len());
        let linkage = mechanism.linkage();
        let within = |wanted: &[usize], have: usize| wanted.iter().all(|&i| i < have);
        let held = request.outputs;
        if !(within(&held.joints, linkage.joints.len())
            && within(&held.links, linkage.links.len())
            && within(&held.slides, linkage.slides.len()))
        {
            return Err(SolveError::Shape("an output's index is beyond what there is".into()));
        }
        let wrong = |what: String| Err(SolveError::Shape(what));
        if request.signs.len() != mechanism.plan().signs() {
            return wrong(format!(
                "{} assembly signs were given, this mechanism has {} dyads with two solutions",
                request.signs.len(),
                mechanism.plan().signs()
            ));
        }
        let designs = request.dimensions.len().checked_div(dimensions).unwrap_or(1);
        if designs * dimensions != request.dimensions.len() {
            return wrong(format!(
                "{} numbers are not a whole number of designs of {dimensions} dimensions",
                request.dimensions.len()
            ));
        }
        let (count, per) = match request.coordinates {
            Coordinates::Shared(q) => (q.len(), drivers),
            Coordinates::PerDesign(q) => (q.len(), drivers * designs),
        };
        if per == 0 || count % per != 0 {
            return wrong(format!(
                "{count} coordinates do not divide into positions of {drivers} drivers"
            ));
        }
        Ok(Self { designs, positions: count / per, drivers, dimensions })
    }
}

/// Entries of the jets that make the tensors of every order.
struct Layout {
    tensors: Vec<Vec<usize>>,
}

impl Layout {
    fn new(jets: &Jets) -> Self {
        Self { tensors: (0..=jets.order).map(|order| jets.tensor(order)).collect() }
    }
}

fn empty(shape: &Shape, request: &Request<'_>, layout: &Layout) -> Motion {
    let rows = shape.designs * shape.positions;
    let track = |components: usize| {
        move |&index: &usize| Track {
            index,
            derivatives: layout
                .tensors
                .iter()
                .map(|t| vec![f64::NAN; rows * components * t.len()])
                .collect(),
        }
    };
    Motion {
        designs: shape.designs,
        positions: shape.positions,
        joints: request.outputs.joints.iter().map(track(2)).collect(),
        links: request.outputs.links.iter().map(track(1)).collect(),
        places: request.outputs.links.iter().map(track(2)).collect(),
        slides: request.outputs.slides.iter().map(track(1)).collect(),
        status: vec![Status::Ok as u8; rows],
    }
}

/// Writes one solved position into its row.
struct Write<'a> {
    mechanism: &'a Mechanism,
    cx: &'a Context<'a>,
    state: &'a State,
    unit: &'a Units,
    layout: &'a Layout,
    row: usize,
    analogues: bool,
}

impl Write<'_> {
    fn all(&self, motion: &mut Motion, way: &Way, at: f64, q: &[f64]) {
        for track in &mut motion.joints {
            self.point(track, point_of_joint(track.index));
        }
        for track in &mut motion.places {
            self.point(track, self.cx.plan.reference[track.index]);
        }
        for track in &mut motion.slides {
            let slide = track.index * self.state.len;
            self.scalar(track, &self.unit.length, |k| self.state.slides[slide + k]);
        }
        for track in &mut motion.links {
            let o = self.cx.plan.link_orientation[track.index];
            let value = self.link_angle(track.index, way, at, q);
            self.scalar(track, &self.unit.angle, |k| {
                if k == 0 { value } else { self.state.theta_of(self.cx, o, k) }
            });
        }
    }

    /// Lifted angle of the class, plus what turns the link against it.
    fn link_angle(&self, link: usize, way: &Way, at: f64, q: &[f64]) -> f64 {
        let rotation = &self.cx.plan.rotation[link];
        let mut angle = 0.0;
        if rotation.class != 0 {
            let principal = self.state.class[rotation.class].angle();
            angle = way.angle(at, rotation.class, principal);
        }
        for (&turns, &q) in rotation.turns.iter().zip(q) {
            if turns != 0 {
                angle += f64::from(turns) * q;
            }
        }
        let whole = std::f64::consts::TAU * self.mechanism.whole_turns[link];
        angle + (self.cx.bound.offset[link] + whole)
    }

    fn point(&self, track: &mut Track, point: usize) {
        let origin = self.cx.bound.origin;
        for (order, (array, tensor)) in
            track.derivatives.iter_mut().zip(&self.layout.tensors).enumerate()
        {
            let out = &mut array[self.row * 2 * tensor.len()..][..2 * tensor.len()];
            for (place, &k) in tensor.iter().enumerate() {
                let p = self.state.points[point * self.state.len + k].scale(self.unit.length[k]);
                if order == 0 {
                    (out[0], out[1]) = (p.x + origin[0], p.y + origin[1]);
                } else {
                    let p = self.analogue(p.x, p.y);
                    (out[place], out[tensor.len() + place]) = p;
                }
            }
        }
    }

    fn scalar(&self, track: &mut Track, factor: &[f64], entry: impl Fn(usize) -> f64) {
        for (order, (array, tensor)) in
            track.derivatives.iter_mut().zip(&self.layout.tensors).enumerate()
        {
            let out = &mut array[self.row * tensor.len()..][..tensor.len()];
            for (place, &k) in tensor.iter().enumerate() {
                let value = entry(k) * factor[k];
                out[place] = if order == 0 { value } else { self.analogue(value, 0.0).0 };
            }
        }
    }

    /// A singular position has no analogues.
    fn analogue(&self, x: f64, y: f64) -> (f64, f64) {
        if self.analogues { (x, y) } else { (f64::NAN, f64::NAN) }
    }
}
