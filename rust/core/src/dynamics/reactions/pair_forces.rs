//! Forces at joints, from the forces in the edges.

use super::force_plan::ForcePlan;
use super::scene::Scene;
use crate::math::lanes::Real;
use crate::math::vector::Vector;
use crate::structure::closure::point_of_joint;

/// How a joint force follows from the forces in edges.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum JointForce {
    /// The force at the end of an edge, less the forces on the link itself of slides that start there.
    Edge { edge: usize, guides: Vec<usize> },
    /// The force at the link's reference point balances all others on it.
    Balance { link: usize, joints: Vec<JointForce>, slides: Vec<(usize, f64)> },
    /// The balance of the forces on the other links there.
    Rest(Vec<JointForce>),
    /// No other link is there.
    Free,
}

impl JointForce {
    /// The force on a link at a joint.
    pub(crate) fn new(
        plan: &ForcePlan,
        links_at: &[Vec<usize>],
        joint: usize,
        link: usize,
    ) -> Self {
        if links_at[joint].len() < 2 || !links_at[joint].contains(&link) {
            return Self::Free;
        }
        if link == plan.ground {
            let other_links = links_at[joint].iter().filter(|&&other_link| other_link != link);
            return Self::Rest(
                other_links
                    .map(|&other_link| Self::new(plan, links_at, joint, other_link))
                    .collect(),
            );
        }
        let point = point_of_joint(joint);
        let is_guide_from = |&edge: &usize| {
            let edge = &plan.edges[edge];
            edge.slide.is_some() && edge.link == link && edge.from == point
        };
        let edge = plan
            .edges
            .iter()
            .position(|edge| edge.slide.is_none() && edge.link == link && edge.to == point);
        if let Some(edge) = edge {
            let guides = (0..plan.edges.len()).filter(is_guide_from).collect();
            return Self::Edge { edge, guides };
        }
        let other_joints = (0..links_at.len())
            .filter(|&other_joint| other_joint != joint && links_at[other_joint].contains(&link))
            .map(|other_joint| Self::new(plan, links_at, other_joint, link))
            .collect();
        let slides = plan
            .edges
            .iter()
            .enumerate()
            .filter_map(|(edge, e)| {
                let [sliding, carrying] = plan.slide_links[e.slide?];
                match link {
                    l if l == carrying => Some((edge, 1.0)),
                    l if l == sliding => Some((edge, -1.0)),
                    _ => None,
                }
            })
            .collect();
        Self::Balance { link, joints: other_joints, slides }
    }

    #[inline(always)]
    pub(crate) fn of<R: Real>(&self, scene: &Scene<R>) -> Vector<R> {
        match self {
            Self::Edge { .. } | Self::Free => self.of_edge(scene),
            Self::Balance { .. } => self.balance(scene),
            Self::Rest(joint_forces) => {
                let mut rest = Vector::ZERO;
                for joint_force in joint_forces {
                    let force = match joint_force {
                        Self::Balance { .. } => joint_force.balance(scene),
                        _ => joint_force.of_edge(scene),
                    };
                    rest = rest - force;
                }
                rest
            }
        }
    }

    #[inline(always)]
    fn of_edge<R: Real>(&self, scene: &Scene<R>) -> Vector<R> {
        let Self::Edge { edge, guides } = self else { return Vector::ZERO };
        let mut sum = scene.edge_force[*edge];
        for &guide in guides {
            sum = sum - scene.edge_force[guide];
        }
        sum
    }

    #[inline(always)]
    fn balance<R: Real>(&self, scene: &Scene<R>) -> Vector<R> {
        let Self::Balance { link, joints, slides } = self else { return Vector::ZERO };
        let mut sum = scene.link_force[*link];
        for joint in joints {
            sum += joint.of_edge(scene);
        }
        for &(edge, sign) in slides {
            sum += scene.edge_force[edge].scale(R::splat(sign));
        }
        -sum
    }
}
