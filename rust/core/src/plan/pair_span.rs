//! Greatest distance between the pairs of a link: the size to which a misfit is relative.

use crate::description::Linkage;
use crate::math::vector::Vector;
use crate::structure::closure::{Closure, Span, point_of_joint};

/// Position of a pair on a link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PairAt {
    /// At its first joint.
    First,
    /// At the far end of an edge.
    Edge(usize),
    /// At a point of the ground.
    Fixed(usize),
}

/// The pairs of every link, then of every guide.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct PairSpans(Vec<Vec<PairAt>>);

impl PairSpans {
    /// Collects the pairs of a linkage.
    #[must_use]
    pub(crate) fn of(linkage: &Linkage, closure: &Closure) -> Self {
        let at_pair = |joint: usize| closure.is_pair(linkage, joint);
        let mut links = vec![Vec::new(); linkage.links.len()];
        for (index, link) in linkage.links.iter().enumerate() {
            for (position, &joint) in link.joints.iter().enumerate() {
                if index == linkage.ground && at_pair(joint) {
                    links[index].push(PairAt::Fixed(point_of_joint(joint)));
                } else if position == 0 && at_pair(joint) {
                    links[index].push(PairAt::First);
                }
            }
        }
        for (index, edge) in closure.edges.iter().enumerate() {
            match edge.span {
                Span::Joint { link, joint } if at_pair(joint) => {
                    links[link].push(PairAt::Edge(index));
                }
                Span::Joint { .. } => {}
                Span::Guide { .. } => links.push(vec![PairAt::First, PairAt::Edge(index)]),
            }
        }
        Self(links)
    }

    /// The longest distance from the first pair of a link to another of its pairs, given the edge
    /// vectors and the coordinates of ground joints.
    #[must_use]
    pub(crate) fn longest(&self, edge_vectors: &[Vector], fixed: &[Vector]) -> f64 {
        let at = |pair: &PairAt| match *pair {
            PairAt::First => Vector::ZERO,
            PairAt::Edge(edge) => edge_vectors[edge],
            PairAt::Fixed(point) => fixed[point],
        };
        let spans = self.0.iter().flat_map(|pairs| {
            pairs.first().into_iter().flat_map(|first| pairs.iter().map(move |p| (first, p)))
        });
        spans.map(|(first, pair)| (at(pair) - at(first)).norm()).fold(0.0, f64::max)
    }
}
