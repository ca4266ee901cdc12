//! The pairs of a machine with friction.

use crate::dynamics::friction::problem::Law;
use crate::dynamics::pair_friction::Friction;
use crate::dynamics::reactions::columns::Sources;
use crate::dynamics::reactions::force_plan::ForcePlan;
use crate::dynamics::reactions::pair_forces::JointForce;

/// Two links with friction between them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FrictionPair {
    pub kind: PairKind,
    pub law: Law,
    /// The law of a pair that is about to move.
    pub static_law: Law,
    pub viscous: f64,
}

/// Where the links touch.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum PairKind {
    /// A link on the pin, which is fast in another one.
    Journal { joint: usize, on: usize, fast: usize, force: JointForce },
    /// A link on a guide.
    Guide { slide: usize, sliding: usize, carrying: usize },
}

impl FrictionPair {
    /// The columns of two rates; their difference is the speed of sliding.
    pub(crate) fn speed_columns(&self, plan: &ForcePlan, sources: &Sources) -> [Option<usize>; 2] {
        match self.kind {
            PairKind::Journal { on, fast, .. } => {
                [on, fast].map(|link| sources.angles[link].filter(|_| link != plan.ground))
            }
            PairKind::Guide { slide, .. } => [sources.slides[slide], None],
        }
    }

    /// The pairs of a machine's friction.
    pub(crate) fn of(
        plan: &ForcePlan,
        links_at: &[Vec<usize>],
        friction: &[Friction],
    ) -> Vec<Self> {
        let mut pairs = Vec::new();
        for friction in friction {
            match *friction {
                Friction::Joint { joint, circle, static_circle, viscous } => {
                    let Some((&fast, bearings)) = links_at[joint].split_first() else { continue };
                    pairs.extend(bearings.iter().map(|&on| Self {
                        kind: PairKind::Journal {
                            joint,
                            on,
                            fast,
                            force: JointForce::new(plan, links_at, joint, on),
                        },
                        law: Law::Journal { circle },
                        static_law: Law::Journal { circle: static_circle },
                        viscous,
                    }));
                }
                Friction::Slide { slide, coefficient, static_coefficient, length, viscous } => {
                    let [sliding, carrying] = plan.slide_links[slide];
                    let half_length = 0.5 * length;
                    pairs.push(Self {
                        kind: PairKind::Guide { slide, sliding, carrying },
                        law: Law::Guide { coefficient, half_length },
                        static_law: Law::Guide { coefficient: static_coefficient, half_length },
                        viscous,
                    });
                }
            }
        }
        pairs
    }
}
