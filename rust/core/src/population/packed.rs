//! A linkage of one crank and dyads as a list of joints, each placed on those before it.

use crate::math::vector::Vector;

/// How a joint is placed. Ends are indices of joints before it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Placement {
    /// Fixed at (x, y).
    Pivot,
    /// At the end of the crank, which turns about joint 0: its vector c at angle zero.
    Crank,
    /// The inner joint of a dyad of two bars, of lengths a and b, on two joints.
    Dyad {
        /// The outer joints: bar a is at the first.
        ends: [usize; 2],
        /// 1 if it lies to the left of the ray from the first end to the second, −1 to its right.
        side: f64,
    },
    /// Fixed to a link: P = I + c (J − I) with I, J two joints of that link.
    Rigid {
        /// I and J.
        ends: [usize; 2],
    },
}

impl Placement {
    /// The joints that it is placed on.
    pub(crate) fn ends(&self) -> &[usize] {
        match self {
            Self::Pivot => &[],
            Self::Crank => &[0],
            Self::Dyad { ends, .. } | Self::Rigid { ends } => ends,
        }
    }

    /// Gives the joints that it is placed on other indices.
    pub(crate) fn renumber(&mut self, index: impl Fn(usize) -> usize) {
        if let Self::Dyad { ends, .. } | Self::Rigid { ends } = self {
            *ends = ends.map(index);
        }
    }
}

/// A linkage of one crank and dyads. Joint 0 is the crank's pivot, joint 1 its pin; the last is traced.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PackedLinkage {
    /// How each joint is placed.
    pub placements: Vec<Placement>,
    /// Its two numbers: (x, y), the components of c, or (a, b).
    pub numbers: Vec<[f64; 2]>,
    /// 1 if the crank turns counter-clockwise, −1 if clockwise.
    pub sense: f64,
}

/// Index of the ground among the links of a packed linkage.
pub(crate) const GROUND: usize = 0;
/// Index of the crank.
pub(crate) const CRANK: usize = 1;

impl PackedLinkage {
    /// The number of joints.
    pub(crate) fn len(&self) -> usize {
        self.placements.len()
    }

    /// Adds a joint; returns its index.
    pub(crate) fn push(&mut self, placement: Placement, numbers: [f64; 2]) -> usize {
        self.placements.push(placement);
        self.numbers.push(numbers);
        self.len() - 1
    }

    /// Adds a joint before another; the indices of that and of later ones grow by one.
    pub(crate) fn insert(&mut self, index: usize, placement: Placement, numbers: [f64; 2]) {
        for later in &mut self.placements[index..] {
            later.renumber(|end| if end >= index { end + 1 } else { end });
        }
        self.placements.insert(index, placement);
        self.numbers.insert(index, numbers);
    }

    /// The joints of each link: ground, crank, then two bars for each dyad. `None` if it is no linkage: a rigid joint must
    /// hang on two joints of one link, a dyad on two that no link has both.
    pub(crate) fn links(&self) -> Option<Vec<Vec<usize>>> {
        if !matches!(self.placements[..], [Placement::Pivot, Placement::Crank, ..]) {
            return None;
        }
        let mut links = vec![vec![0], vec![0, 1]];
        for (joint, placement) in self.placements.iter().enumerate().skip(2) {
            let common = |links: &[Vec<usize>], ends: &[usize; 2]| {
                links.iter().position(|link| ends.iter().all(|end| link.contains(end)))
            };
            match placement {
                Placement::Pivot => links[GROUND].push(joint),
                Placement::Crank => return None,
                Placement::Dyad { ends, .. } => {
                    if ends[0] == ends[1] || common(&links, ends).is_some() {
                        return None;
                    }
                    links.extend(ends.map(|end| vec![end, joint]));
                }
                Placement::Rigid { ends } => {
                    let link = common(&links, ends).filter(|&link| link != GROUND)?;
                    if ends[0] == ends[1] {
                        return None;
                    }
                    links[link].push(joint);
                }
            }
        }
        Some(links)
    }

    /// Removes joints that do not move the last one. `false` if the crank is among them.
    pub(crate) fn prune(&mut self) -> bool {
        let mut needed = vec![false; self.len()];
        if let Some(last) = needed.last_mut() {
            *last = true;
        }
        for joint in (0..self.len()).rev() {
            if needed[joint] {
                for &end in self.placements[joint].ends() {
                    needed[end] = true;
                }
            }
        }
        if !needed[..2].iter().all(|&is| is) {
            return false;
        }
        let mut index = Vec::with_capacity(needed.len());
        let mut count = 0;
        for &is in &needed {
            index.push(count);
            count += usize::from(is);
        }
        for joint in (0..self.len()).rev() {
            if needed[joint] {
                self.placements[joint].renumber(|end| index[end]);
            } else {
                self.placements.remove(joint);
                self.numbers.remove(joint);
            }
        }
        true
    }

    /// Keeps the joints up to `joint`, which becomes the traced one, and those of them that move it.
    pub(crate) fn trace(&mut self, joint: usize) -> bool {
        self.placements.truncate(joint + 1);
        self.numbers.truncate(joint + 1);
        self.prune()
    }

    /// The same linkage moved: point z goes to `at` + `by` z, of `conj`(z) if it is mirrored.
    pub(crate) fn transform(&mut self, by: Vector, at: Vector, mirrored: bool) {
        let flip = |z: Vector| if mirrored { z.conj() } else { z };
        let scale = by.norm();
        for (placement, numbers) in self.placements.iter_mut().zip(&mut self.numbers) {
            let z = flip(Vector::new(numbers[0], numbers[1]));
            let z = match placement {
                Placement::Pivot => at + by * z,
                Placement::Crank => by * z,
                Placement::Rigid { .. } => z,
                Placement::Dyad { side, .. } => {
                    if mirrored {
                        *side = -*side;
                    }
                    *numbers = numbers.map(|length| length * scale);
                    continue;
                }
            };
            *numbers = [z.x, z.y];
        }
        if mirrored {
            self.sense = -self.sense;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Crank, ground pivot, dyad, coupler point.
    fn four_bar() -> PackedLinkage {
        PackedLinkage {
            placements: vec![
                Placement::Pivot,
                Placement::Crank,
                Placement::Pivot,
                Placement::Dyad { ends: [1, 2], side: 1.0 },
                Placement::Rigid { ends: [1, 3] },
            ],
            numbers: vec![[0.0, 0.0], [1.0, 0.0], [4.5, 0.0], [4.0, 3.0], [0.5, 0.25]],
            sense: 1.0,
        }
    }

    #[test]
    fn links_have_their_joints() {
        let links = four_bar().links().expect("a linkage");
        assert_eq!(links, [vec![0, 2], vec![0, 1], vec![1, 3, 4], vec![2, 3]]);
    }

    #[test]
    fn a_rigid_joint_hangs_on_one_link() {
        let mut linkage = four_bar();
        linkage.placements[4] = Placement::Rigid { ends: [0, 3] };
        assert_eq!(linkage.links(), None);
        linkage.placements[4] = Placement::Rigid { ends: [0, 2] };
        assert_eq!(linkage.links(), None);
    }

    #[test]
    fn a_dyad_does_not_hang_on_one_link() {
        let mut linkage = four_bar();
        linkage.placements[4] = Placement::Dyad { ends: [1, 3], side: 1.0 };
        assert_eq!(linkage.links(), None);
    }

    #[test]
    fn what_does_not_move_the_last_joint_goes() {
        let mut linkage = four_bar();
        linkage.insert(2, Placement::Rigid { ends: [0, 1] }, [2.0, 0.0]);
        assert_eq!(linkage.placements[4], Placement::Dyad { ends: [1, 3], side: 1.0 });
        assert!(linkage.prune());
        assert_eq!(linkage, four_bar());
        assert!(linkage.trace(3));
        assert_eq!(linkage.len(), 4);
        assert!(!linkage.trace(2), "a pivot is not moved by the crank");
    }
}
