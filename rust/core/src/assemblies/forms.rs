//! The closures of a group as equations between complex numbers.
//!
//! A rotation is T, a vector along a guide v; T′ and v′, their conjugates at a real position, are
//! separate unknowns. A loop is linear in X = (1, T …, v …), and its conjugate in Y = (1, T′ …,
//! v′ …). After the chords are eliminated, bilinear forms Xᵀ M Y = 0 remain:
//!
//! ```text
//! T T′ = 1                 a rotation
//! E E′ = c c′              a binary link c as chord: E, the vector between its ends, is linear in X
//! v g′ T′ = v′ g T         a vector v along a guide g that turns with T
//! ```
//!
//! So a group of 2 n links is 2 n forms of bidegree (1, 1), and has at most C(2n, n) complex assemblies
//! (C. W. Wampler, *Displacement analysis of spherical/planar mechanisms*, J. Mech. Des. 121 (1999),
//! uses the same unknowns).

use crate::plan::dyad::Unknown;
use crate::plan::group::{Chord, Group};
use crate::plan::plan::{EdgeSlide, Plan};

/// A constant of a design at a position; complex, with its conjugate beside it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Parameter {
    /// The constant part of an edge: index among the group's edges.
    Edge(usize),
    /// The direction of the guide along an edge.
    Guide(usize),
    /// A point that earlier steps have placed: index among the group's.
    Point(usize),
}

/// A sum of variables, each times a parameter or 1. Variable 0 is the constant 1.
#[derive(Debug, Clone, Default)]
pub(super) struct LinearForm {
    pub terms: Vec<(usize, Parameter, f64)>,
    pub units: Vec<(usize, f64)>,
}

/// One equation.
#[derive(Debug, Clone)]
pub(super) enum Equation {
    /// A rotation has length 1.
    Rotation { variable: usize },
    /// A vector is as long as an edge.
    Length { vector: LinearForm, edge: usize },
    /// A vector is along the guide of an edge, which turns with a variable (0: known).
    Guide { vector: LinearForm, edge: usize, turn: usize },
    /// A sum vanishes, and its conjugate: two equations.
    Vanishes { sum: LinearForm },
}

/// The equations of a group.
#[derive(Debug, Clone, Default)]
pub(super) struct GroupForms {
    /// Variables of X, without the constant: the unknowns of the group, in order.
    pub variables: usize,
    /// Number of its edges.
    pub edges: usize,
    /// Its known points.
    pub points: Vec<usize>,
    pub equations: Vec<Equation>,
    /// For every variable that is a vector along a guide: the edge, and the variable that turns it.
    pub guides: Vec<Option<(usize, usize)>>,
}

impl GroupForms {
    pub(super) fn new(plan: &Plan, group: &Group) -> Self {
        let variables = group.unknowns.len();
        let mut forms = Self {
            variables,
            edges: group.edges.len(),
            points: Vec::new(),
            equations: Vec::new(),
            guides: vec![None; variables],
        };
        for (index, &unknown) in group.unknowns.iter().enumerate() {
            let variable = index + 1;
            match unknown {
                Unknown::Class(_) => forms.equations.push(Equation::Rotation { variable }),
                Unknown::Slide(_) => {
                    let edge = group.edges.iter().position(|edge| edge.slides == Some(index));
                    let edge = edge.unwrap_or(0);
                    let turn = group.edges[edge].turns.map_or(0, |unknown| unknown + 1);
                    let vector =
                        LinearForm { units: vec![(variable, 1.0)], ..LinearForm::default() };
                    forms.guides[index] = Some((edge, turn));
                    forms.equations.push(Equation::Guide { vector, edge, turn });
                }
            }
        }
        for l in &group.loops {
            let mut vector = LinearForm::default();
            if l.start != l.end {
                for (point, sign) in [(l.end, 1.0), (l.start, -1.0)] {
                    let index = forms.point(point);
                    vector.terms.push((0, Parameter::Point(index), sign));
                }
            }
            for part in &l.path {
                add_edge(&mut vector, group, part.edge, if part.backward { -1.0 } else { 1.0 });
            }
            let edge = l.edge;
            let turn = group.edges[edge].turns.map_or(0, |unknown| unknown + 1);
            forms.equations.push(match l.chord {
                Chord::Length { .. } => Equation::Length { vector, edge },
                Chord::Guide { .. } => {
                    vector.terms.push((turn, Parameter::Edge(edge), -1.0));
                    Equation::Guide { vector, edge, turn }
                }
                Chord::Whole => {
                    add_edge(&mut vector, group, edge, -1.0);
                    Equation::Vanishes { sum: vector }
                }
            });
        }
        debug_assert!(group.edges.iter().all(|edge| {
            edge.slides.is_none() || matches!(plan.edges[edge.edge].along, EdgeSlide::Slide(_))
        }));
        forms
    }

    fn point(&mut self, point: usize) -> usize {
        self.points.iter().position(|&index| index == point).unwrap_or_else(|| {
            self.points.push(point);
            self.points.len() - 1
        })
    }

    /// Index of a parameter.
    pub(super) fn index(&self, parameter: Parameter) -> usize {
        match parameter {
            Parameter::Edge(edge) => edge,
            Parameter::Guide(edge) => self.edges + edge,
            Parameter::Point(point) => 2 * self.edges + point,
        }
    }

    /// Half the number of bilinear forms, n.
    pub(super) fn half(&self) -> usize {
        let linear =
            self.equations.iter().filter(|e| matches!(e, Equation::Vanishes { .. })).count();
        self.variables - linear
    }
}

/// Adds an edge of a group, times a sign, to a sum.
fn add_edge(sum: &mut LinearForm, group: &Group, edge: usize, sign: f64) {
    let group_edge = &group.edges[edge];
    let turn = group_edge.turns.map_or(0, |unknown| unknown + 1);
    sum.terms.push((turn, Parameter::Edge(edge), sign));
    if let Some(unknown) = group_edge.slides {
        sum.units.push((unknown + 1, sign));
    }
}
