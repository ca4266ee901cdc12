//! Equal parts of a drawing: the sides of parallelograms, and parallel guides. Most redundant links fit
//! because of equal parts, and the equations that make parts equal are linear.

use nalgebra::{DMatrix, DVector};

use super::drawing_change::{Tolerance, Weights, changed};
use super::least_norm::least_norm;
use crate::description::Linkage;

/// Greatest difference of two equal vectors, in units of the tolerance of their four ends.
const ENDS: f64 = 4.0;
/// Least length of a vector, in units of the tolerance: the direction of a shorter one is not known.
const LEAST_LENGTH: f64 = 16.0;
/// Most equations that are solved.
const MOST_EQUATIONS: usize = 2000;

/// One equation: the unknowns with their factors, and its misfit.
type Equation = (Vec<(usize, f64)>, f64);

/// The drawing in which parts of the named links and slides that are equal within a tolerance are equal to
/// rounding. `None` if no parts are equal.
pub(super) fn with_equal_parts(
    linkage: &Linkage,
    named: &[String],
    tolerance: Tolerance,
    weights: &Weights,
    size: f64,
) -> Option<Linkage> {
    let mut equations = equal_vectors(linkage, named, tolerance, size);
    equations.extend(parallel_guides(linkage, named, tolerance));
    if equations.is_empty() || equations.len() > MOST_EQUATIONS {
        return None;
    }
    let mut rows = DMatrix::zeros(equations.len(), weights.0.len());
    for (row, (terms, _)) in equations.iter().enumerate() {
        for &(unknown, factor) in terms {
            rows[(row, unknown)] += factor * weights.0[unknown];
        }
    }
    let misfits = DVector::from_iterator(equations.len(), equations.iter().map(|e| e.1));
    let change = least_norm(rows, &misfits, 0.0).component_mul(&weights.0);
    Some(changed(linkage, &change, size))
}

/// Equations for vectors between two joints of a link that are equal to those of another link.
fn equal_vectors(
    linkage: &Linkage,
    named: &[String],
    tolerance: Tolerance,
    size: f64,
) -> Vec<Equation> {
    let mut vectors = Vec::new();
    for (index, link) in linkage.links.iter().enumerate() {
        if index != linkage.ground && !named.contains(&link.name) {
            continue;
        }
        for (n, &from) in link.joints.iter().enumerate() {
            for &to in &link.joints[..n] {
                let span = [0, 1].map(|k| linkage.joints[to].at[k] - linkage.joints[from].at[k]);
                if span[0].abs().max(span[1].abs()) > LEAST_LENGTH * tolerance.length {
                    vectors.push((index, from, to, span));
                    vectors.push((index, to, from, span.map(|x| -x)));
                }
            }
        }
    }
    let mut equations = Vec::new();
    for (n, &(link, from, to, span)) in vectors.iter().enumerate() {
        for &(other_link, start, end, other_span) in &vectors[..n] {
            let apart = [0, 1].map(|k| span[k] - other_span[k]);
            let is_near = apart.iter().all(|x| x.abs() <= ENDS * tolerance.length);
            // Each pair is met in both senses.
            let is_new = link != other_link && from > to && (from, to) != (start, end);
            if is_near && is_new && equations.len() <= MOST_EQUATIONS {
                for (k, misfit) in apart.into_iter().enumerate() {
                    let term = |joint: usize, factor: f64| (2 * joint + k, factor);
                    let terms =
                        vec![term(to, 1.0), term(from, -1.0), term(end, -1.0), term(start, 1.0)];
                    equations.push((terms, misfit / size));
                }
            }
        }
    }
    equations
}

/// Equations for guides that are parallel.
fn parallel_guides(linkage: &Linkage, named: &[String], tolerance: Tolerance) -> Vec<Equation> {
    let first = 2 * linkage.joints.len();
    let is_named = |slide: usize| named.contains(&linkage.slides[slide].name);
    let guides: Vec<usize> = (0..linkage.slides.len()).filter(|&s| is_named(s)).collect();
    let mut equations = Vec::new();
    for (n, &guide) in guides.iter().enumerate() {
        for &earlier in &guides[..n] {
            let between = linkage.slides[guide].angle - linkage.slides[earlier].angle;
            let half_turns = (between / std::f64::consts::PI).round();
            let apart = between - half_turns * std::f64::consts::PI;
            if apart.abs() <= 2.0 * tolerance.angle {
                equations.push((vec![(first + guide, 1.0), (first + earlier, -1.0)], apart));
            }
        }
    }
    equations
}
