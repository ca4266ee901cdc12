//! Which equations determine which unknowns, and in what order: the fine
//! Dulmage-Mendelsohn decomposition of a square system (Dulmage & Mendelsohn
//! 1958; Pothen & Fan 1990), on nodes that stand for several scalars each.

/// A set of unknowns that is solved together, from a set of equations.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Block {
    /// Indices of unknowns.
    pub unknowns: Vec<usize>,
    /// Indices of equations.
    pub equations: Vec<usize>,
}

/// A system of equations: `touches[e]` are the unknowns in equation `e`.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pattern {
    /// Scalars in every unknown.
    pub unknown_size: Vec<usize>,
    /// Scalars in every equation.
    pub equation_size: Vec<usize>,
    /// Unknowns that appear in every equation.
    pub touches: Vec<Vec<usize>>,
}

impl Pattern {
    /// Adds an unknown of `size` scalars.
    pub(crate) fn unknown(&mut self, size: usize) -> usize {
        self.unknown_size.push(size);
        self.unknown_size.len() - 1
    }

    /// Adds an equation of `size` scalars.
    pub(crate) fn equation(&mut self, size: usize, touches: Vec<usize>) -> usize {
        self.equation_size.push(size);
        self.touches.push(touches);
        self.touches.len() - 1
    }

    /// Blocks in solving order; None if the system is not structurally square
    /// and regular.
    #[must_use]
    pub(crate) fn blocks(&self) -> Option<Vec<Block>> {
        let matched = self.matching()?;
        let components = self.components(&matched);
        let count = components.iter().max().map_or(0, |m| m + 1);
        let mut blocks = vec![Block::default(); count];
        for (unknown, &component) in components.iter().enumerate() {
            blocks[component].unknowns.push(unknown);
        }
        for (equation, partners) in matched.iter().enumerate() {
            // All partners of one equation share a block: the equation touches each of them.
            if let Some(&unknown) = partners.first() {
                blocks[components[unknown]].equations.push(equation);
            }
        }
        Some(blocks)
    }

    /// For every equation, the unknowns its scalars are matched to (Kuhn's
    /// augmenting paths). None unless every scalar is matched.
    fn matching(&self) -> Option<Vec<Vec<usize>>> {
        if self.unknown_size.iter().sum::<usize>() != self.equation_size.iter().sum::<usize>() {
            return None;
        }
        let mut of_unknown: Vec<Vec<usize>> = vec![Vec::new(); self.unknown_size.len()];
        for equation in 0..self.touches.len() {
            for _ in 0..self.equation_size[equation] {
                let mut seen = vec![false; self.unknown_size.len()];
                if !self.augment(equation, &mut of_unknown, &mut seen) {
                    return None;
                }
            }
        }
        let mut of_equation = vec![Vec::new(); self.touches.len()];
        for (unknown, equations) in of_unknown.iter().enumerate() {
            for &equation in equations {
                of_equation[equation].push(unknown);
            }
        }
        Some(of_equation)
    }

    /// Matches one scalar more of an equation, along an augmenting path. (The path is as long as
    /// the linkage, so it is kept in a list and not on the thread's stack.)
    fn augment(&self, equation: usize, of_unknown: &mut [Vec<usize>], seen: &mut [bool]) -> bool {
        /// An equation that looks for a place at the unknowns it touches, from `touch` on; `slot`:
        /// which of that unknown's partners is asked to move.
        struct Search {
            equation: usize,
            touch: usize,
            slot: usize,
        }
        let mut path = vec![Search { equation, touch: 0, slot: 0 }];
        while let Some(top) = path.last_mut() {
            let Some(&unknown) = self.touches[top.equation].get(top.touch) else {
                path.pop();
                if let Some(before) = path.last_mut() {
                    before.slot += 1;
                }
                continue;
            };
            if top.slot == 0 {
                if seen[unknown] {
                    top.touch += 1;
                    continue;
                }
                seen[unknown] = true;
                if of_unknown[unknown].len() < self.unknown_size[unknown] {
                    of_unknown[unknown].push(top.equation);
                    path.pop();
                    for search in path {
                        let unknown = self.touches[search.equation][search.touch];
                        of_unknown[unknown][search.slot] = search.equation;
                    }
                    return true;
                }
            }
            if let Some(&equation) = of_unknown[unknown].get(top.slot) {
                path.push(Search { equation, touch: 0, slot: 0 });
            } else {
                (top.touch, top.slot) = (top.touch + 1, 0);
            }
        }
        false
    }

    /// Strongly connected components of "to solve `u`, its equation needs `v`",
    /// numbered so that what is needed comes first (Tarjan 1972).
    fn components(&self, of_equation: &[Vec<usize>]) -> Vec<usize> {
        let n = self.unknown_size.len();
        let mut needs = vec![Vec::new(); n];
        for (equation, partners) in of_equation.iter().enumerate() {
            for &unknown in partners {
                needs[unknown].extend(self.touches[equation].iter().copied());
            }
        }
        let mut tarjan = Tarjan {
            needs: &needs,
            index: vec![usize::MAX; n],
            low: vec![0; n],
            component: vec![usize::MAX; n],
            stack: Vec::new(),
            next: 0,
            components: 0,
        };
        for u in 0..n {
            if tarjan.index[u] == usize::MAX {
                tarjan.visit_from(u);
            }
        }
        tarjan.component
    }
}

struct Tarjan<'a> {
    needs: &'a [Vec<usize>],
    index: Vec<usize>,
    low: Vec<usize>,
    component: Vec<usize>,
    stack: Vec<usize>,
    next: usize,
    components: usize,
}

impl Tarjan<'_> {
    /// Visits what can be reached from an unknown, depth first. (The depth is that of the linkage:
    /// the path is kept in a list and not on the thread's stack.)
    fn visit_from(&mut self, root: usize) {
        // Every unknown on the path, with how many of those it needs have been looked at.
        let mut path = vec![(root, 0)];
        self.enter(root);
        while let Some((u, looked)) = path.last_mut() {
            let u = *u;
            if let Some(&v) = self.needs[u].get(*looked) {
                *looked += 1;
                if self.index[v] == usize::MAX {
                    self.enter(v);
                    path.push((v, 0));
                } else if self.component[v] == usize::MAX {
                    self.low[u] = self.low[u].min(self.index[v]);
                }
                continue;
            }
            path.pop();
            if let Some(&(before, _)) = path.last() {
                self.low[before] = self.low[before].min(self.low[u]);
            }
            self.leave(u);
        }
    }

    fn enter(&mut self, u: usize) {
        self.index[u] = self.next;
        self.low[u] = self.next;
        self.next += 1;
        self.stack.push(u);
    }

    /// Closes the component of which an unknown is the root.
    fn leave(&mut self, u: usize) {
        if self.low[u] == self.index[u] {
            while let Some(v) = self.stack.pop() {
                self.component[v] = self.components;
                if v == u {
                    break;
                }
            }
            self.components += 1;
        }
    }
}
