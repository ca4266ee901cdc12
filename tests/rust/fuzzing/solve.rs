//! Mechanisms of the grammar moved: odd designs and coordinates beside sane ones.

use arbitrary::Unstructured;
use assur::tolerance::{CLOSURE_PER_CONDITION, REDUNDANT_CLOSURE, SINGULAR_CONDITION};
use assur::{
    Control, Coordinates, Diagnosis, Mechanism, Motion, Outputs, Product, Quantity, Request,
    SensitivityRequest, Series, SolveError, Status,
};

use super::closures::Row;
use super::request::Question;
use super::{Shown, check_sentence, grammar};

/// Statuses up to this one have a position.
const LAST_WITH_POSITION: u8 = Status::Singular as u8;
const LAST: u8 = Status::BadInput as u8;
/// Dyads whose assemblies are all looked at, at most: each may double their number.
const MOST_SIGNS: usize = 4;

/// Every position has a status, values that suit it, the bits that it has alone, and closes.
pub fn solve(data: &[u8]) {
    let (head, tail) = data.split_at(data.len().min(Question::BYTES));
    let Ok(question) = Question::read(&mut Unstructured::new(head)) else { return };
    let Ok(description) = grammar::linkage(&mut Unstructured::new(tail)) else { return };
    let _shown = Shown(&description);
    let Ok(mechanism) = Mechanism::new(&description) else { return };
    let case = Case {
        dimensions: question.dimensions(&mechanism),
        coordinates: question.coordinates(&mechanism),
        signs: question.signs(&mechanism),
        by: question.by.map(|by| usize::from(by) % mechanism.drawing().len().max(1)),
        outputs: question.outputs(&mechanism),
        mechanism: &mechanism,
        question: &question,
    };
    let request = case.request();
    let _asked = Shown(&request);
    match mechanism.solve(&request) {
        Ok(motion) => case.check(&motion),
        Err(error) => case.check_refusal(&error),
    }
}

struct Case<'a> {
    mechanism: &'a Mechanism,
    question: &'a Question,
    dimensions: Vec<f64>,
    coordinates: Vec<f64>,
    signs: Vec<i8>,
    by: Option<usize>,
    outputs: Outputs,
}

/// One position: its design's dimensions, its coordinates, its row in the batch.
struct Position<'a> {
    dimensions: Vec<f64>,
    q: &'a [f64],
    row: usize,
}

impl Case<'_> {
    fn request(&self) -> Request<'_> {
        Request {
            dimensions: &self.dimensions,
            coordinates: if self.question.per_design {
                Coordinates::PerDesign(&self.coordinates)
            } else {
                Coordinates::Shared(&self.coordinates)
            },
            signs: &self.signs,
            order: self.question.order,
            outputs: &self.outputs,
        }
    }

    fn has_redundant_parts(&self) -> bool {
        let redundant = &self.mechanism.structure().redundant;
        !(redundant.links.is_empty() && redundant.slides.is_empty())
    }

    /// Only what cannot be asked is refused.
    fn check_refusal(&self, error: &SolveError) {
        check_sentence(&error.to_string());
        let is_meant = match error {
            SolveError::Order(order) => *order > 3,
            SolveError::Redundant { .. } => self.has_redundant_parts(),
            SolveError::Shape(_) => {
                self.mechanism.drawing().is_empty()
                    || self.question.per_design && self.dimensions.is_empty()
            }
            _ => false,
        };
        assert!(is_meant, "{error}");
    }

    fn check(&self, motion: &Motion) {
        assert!(self.question.order <= 3, "order {}", self.question.order);
        assert_eq!(motion.status.len(), motion.designs * motion.positions);
        for position in self.positions(motion) {
            self.check_values(motion, &position);
        }
        if motion.status.is_empty() {
            return;
        }
        for index in self.question.alone {
            let row = usize::from(index) % motion.status.len();
            if let Some(position) = self.positions(motion).nth(row) {
                self.check_alone(motion, &position);
            }
        }
        self.check_closed(motion);
        self.check_assemblies(motion);
        if let Some(by) = self.by {
            self.check_sensitivities(motion, by);
        }
    }

    fn positions<'a>(&'a self, motion: &Motion) -> impl Iterator<Item = Position<'a>> {
        let (count, drivers) = (motion.positions, self.mechanism.q0().len());
        let designs = motion.designs;
        let per_design = self.question.per_design;
        (0..motion.designs * count).map(move |row| {
            let at = if per_design { row } else { row % count };
            Position {
                dimensions: self
                    .dimensions
                    .iter()
                    .skip(row / count)
                    .step_by(designs)
                    .copied()
                    .collect(),
                q: &self.coordinates[at * drivers..][..drivers],
                row,
            }
        })
    }

    /// The status is one, fits the input, and says which numbers there are.
    fn check_values(&self, motion: &Motion, position: &Position<'_>) {
        let status = motion.status[position.row];
        assert!(status <= LAST, "status {status}");
        let is_bad = self.mechanism.dimensions().first_fault(&position.dimensions).is_some();
        assert_eq!(status == Status::BadDimension as u8, is_bad, "{:?}", position.dimensions);
        if !is_bad && position.q.iter().any(|q| !q.is_finite()) {
            assert_eq!(status, Status::BadInput as u8, "at q = {:?}", position.q);
        }
        let numbers = Self::numbers(motion, position.row);
        if status > LAST_WITH_POSITION {
            let all = numbers.iter().all(|(_, x)| x.is_nan());
            assert!(all, "status {status} at q = {:?} has numbers", position.q);
        } else {
            let is_given = |order: usize, x: f64| match order {
                0 => x.is_finite(),
                // Beyond the range of numbers where a slide is driven.
                _ => !x.is_nan() || status == Status::Singular as u8,
            };
            let all = numbers.iter().all(|&(order, x)| is_given(order, x));
            assert!(all, "status {status} at q = {:?}: {numbers:?}", position.q);
        }
    }

    /// All numbers of a row with their orders.
    fn numbers(motion: &Motion, row: usize) -> Vec<(usize, f64)> {
        let rows = motion.status.len();
        let tracks = [&motion.joints, &motion.origins, &motion.slides, &motion.links];
        let of_track = |track: &Series| {
            let of_order = |(order, values): (usize, &Vec<f64>)| {
                let width = values.len() / rows;
                values[row * width..][..width].iter().map(move |&x| (order, x)).collect::<Vec<_>>()
            };
            track.derivatives.iter().enumerate().flat_map(of_order).collect::<Vec<_>>()
        };
        tracks.into_iter().flatten().flat_map(of_track).collect()
    }

    fn check_alone(&self, motion: &Motion, position: &Position<'_>) {
        let alone = self.mechanism.solve(&Request {
            dimensions: &position.dimensions,
            coordinates: Coordinates::Shared(position.q),
            ..self.request()
        });
        let alone = alone.expect("what was solved in a batch is solved alone");
        assert_eq!(alone.status[0], motion.status[position.row], "alone at q = {:?}", position.q);
        let pairs = Self::numbers(motion, position.row).into_iter().zip(Self::numbers(&alone, 0));
        for ((order, batch), (_, alone)) in pairs {
            let same = batch.to_bits() == alone.to_bits() || batch.is_nan() && alone.is_nan();
            assert!(same, "{batch:e} of order {order} is {alone:e} alone at q = {:?}", position.q);
        }
    }

    /// Derivatives by a dimension are numbers or NaN as their statuses say, and forward and backward the
    /// same.
    fn check_sensitivities(&self, motion: &Motion, by: usize) {
        let request = self.request();
        let joints = self.outputs.joints.iter().map(|&joint| (Quantity::Joint(joint), 0));
        let slides = self.outputs.slides.iter().map(|&slide| (Quantity::Slide(slide), 0));
        let of: Vec<(Quantity, usize)> = joints.chain(slides).collect();
        let mut rates = vec![0.0; self.mechanism.drawing().len()];
        rates[by] = 1.0;
        let derive = |product| {
            let asked = SensitivityRequest {
                dimensions: request.dimensions,
                coordinates: request.coordinates,
                signs: request.signs,
                of: &of,
                product,
            };
            self.mechanism.sensitivities(&asked, &Control::default())
        };
        let by = [by];
        let (back, status) = match derive(Product::Jacobian { by: &by }) {
            Ok(found) => found,
            Err(error) => return self.check_refusal(&error),
        };
        let (forward, _) = derive(Product::Forward { rates: &rates }).expect("both are there");
        for (row, (&found, &solved)) in status.iter().zip(&motion.status).enumerate() {
            assert!(found == solved || found == Status::Singular as u8, "{found} of {solved}");
            for (back, forward) in back.iter().zip(&forward) {
                let width = back.len() / status.len();
                for index in row * width..(row + 1) * width {
                    let (back, forward) = (back[index], forward[index]);
                    assert_eq!(back.is_nan(), forward.is_nan(), "{back} and {forward}");
                    assert!(found < LAST_WITH_POSITION || back.is_nan(), "{back} of {found}");
                }
            }
        }
    }

    /// Every assembly that exists at a position is solved there.
    fn check_assemblies(&self, motion: &Motion) {
        if self.mechanism.signs().len() > MOST_SIGNS {
            return;
        }
        let row = usize::from(self.question.alone[0]) % motion.status.len();
        let Some(position) = self.positions(motion).nth(row) else { return };
        let found = self.mechanism.assemblies(&position.dimensions, position.q, None);
        let found = match found {
            Ok(found) => found.found,
            Err(error) => return check_sentence(&error.to_string()),
        };
        if self.mechanism.structure().class() > 2 {
            return;
        }
        let found: Vec<Vec<i8>> = found.into_iter().map(|assembly| assembly.signs).collect();
        for (index, signs) in found.iter().enumerate() {
            let diagnosis = self.mechanism.diagnose(&position.dimensions, position.q, signs);
            let diagnosis = &diagnosis.expect("an assembly of this mechanism")[0];
            let status = diagnosis.status as u8;
            assert!(status <= LAST_WITH_POSITION, "{signs:?}: {diagnosis}");
            // Of a flat dyad both assemblies are one, and a redundant link may fit both by its
            // tolerance.
            let is_one = status == LAST_WITH_POSITION || self.has_redundant_parts();
            let again = !is_one && found[..index].contains(signs);
            assert!(!again, "{signs:?} twice: {diagnosis}");
        }
    }

    /// What is given as solved closes, by the core's residual and by the numbers alone; and the
    /// values do not depend on what else is asked for.
    fn check_closed(&self, motion: &Motion) {
        let all = Outputs {
            origins: (0..self.mechanism.linkage().links.len()).collect(),
            ..Outputs::all(self.mechanism)
        };
        let whole = self.mechanism.solve(&Request { order: 0, outputs: &all, ..self.request() });
        let whole = whole.expect("the same request, to order 0");
        assert_eq!(whole.status, motion.status, "status of order 0");
        for track in &motion.joints {
            let same = track.derivatives[0].iter().zip(&whole.joints[track.index].derivatives[0]);
            let differs =
                |(_, (a, b)): &(usize, (&f64, &f64))| a.to_bits() != b.to_bits() && !a.is_nan();
            let apart: Vec<_> = same.enumerate().filter(differs).collect();
            assert!(apart.is_empty(), "joint {}: {apart:?}", track.index);
        }
        let positions: Vec<Position<'_>> = self.positions(motion).collect();
        for design in positions.chunks(motion.positions) {
            let q: Vec<f64> = design.iter().flat_map(|position| position.q).copied().collect();
            let found = self.mechanism.diagnose(&design[0].dimensions, &q, &self.signs);
            let found = found.expect("positions of this mechanism");
            for (position, diagnosis) in design.iter().zip(&found) {
                self.check_position(&whole, position, diagnosis);
            }
        }
    }

    fn check_position(&self, whole: &Motion, position: &Position<'_>, diagnosis: &Diagnosis) {
        let status = whole.status[position.row];
        check_sentence(&diagnosis.to_string());
        assert_eq!(diagnosis.status as u8, status, "{diagnosis}");
        if status > LAST_WITH_POSITION {
            return;
        }
        // A flat dyad cannot be told from one of this condition.
        let is_flat = status == Status::Singular as u8;
        let condition = diagnosis.condition.max(if is_flat { SINGULAR_CONDITION } else { 1.0 });
        // A redundant link of a changed design may miss by more.
        let redundant = if self.has_redundant_parts() { REDUNDANT_CLOSURE } else { 0.0 };
        let law = redundant.max(CLOSURE_PER_CONDITION * condition);
        let row = Row {
            mechanism: self.mechanism,
            dimensions: &position.dimensions,
            motion: whole,
            index: position.row,
        };
        let (residual, allowed) = (diagnosis.residual, law * row.reach().max(1.0));
        assert!(residual <= allowed, "residual {residual:e} > {allowed:e}: {diagnosis}");
        // Two points and the angle between them are each good to the law.
        let (misfit, allowed) = (row.misfit(position.q), 3.0 * law * row.size(position.q));
        assert!(misfit <= allowed, "misfit {misfit:e} m > {allowed:e}: {diagnosis}");
    }
}
