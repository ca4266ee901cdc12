//! Which equations determine which unknowns, and in what order: the fine
//! Dulmage-Mendelsohn decomposition of a square system (Dulmage & Mendelsohn
//! 1958; Pothen & Fan 1990), on nodes that stand for several scalars each.

/// A set of unknowns that is solved together, from a set of equations.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Block {
    /// Indices of unknowns.
    pub unknowns: Vec<usize>,
    /// Indices of equations.
    pub equations: Vec<usize>,
}

/// A system of equations: `touches[e]` are the unknowns in equation `e`.
#[derive(Debug, Clone, Default)]
pub struct Pattern {
    /// Scalars in every unknown.
    pub unknown_size: Vec<usize>,
    /// Scalars in every equation.
    pub equation_size: Vec<usize>,
    /// Unknowns that appear in every equation.
    pub touches: Vec<Vec<usize>>,
}

impl Pattern {
    /// Adds an unknown of `size` scalars.
    pub fn unknown(&mut self, size: usize) -> usize {
        self.unknown_size.push(size);
        self.unknown_size.len() - 1
    }

    /// Adds an equation of `size` scalars.
    pub fn equation(&mut self, size: usize, touches: Vec<usize>) -> usize {
        self.equation_size.push(size);
        self.touches.push(touches);
        self.touches.len() - 1
    }

    /// Blocks in solving order; None if the system is not structurally square
    /// and regular.
    #[must_use]
    pub fn blocks(&self) -> Option<Vec<Block>> {
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

    fn augment(&self, equation: usize, of_unknown: &mut [Vec<usize>], seen: &mut [bool]) -> bool {
        for &unknown in &self.touches[equation] {
            if seen[unknown] {
                continue;
            }
            seen[unknown] = true;
            if of_unknown[unknown].len() < self.unknown_size[unknown] {
                of_unknown[unknown].push(equation);
                return true;
            }
            for slot in 0..of_unknown[unknown].len() {
                let other = of_unknown[unknown][slot];
                if self.augment(other, of_unknown, seen) {
                    of_unknown[unknown][slot] = equation;
                    return true;
                }
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
                tarjan.visit(u);
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
    fn visit(&mut self, u: usize) {
        self.index[u] = self.next;
        self.low[u] = self.next;
        self.next += 1;
        self.stack.push(u);
        for &v in &self.needs[u] {
            if self.index[v] == usize::MAX {
                self.visit(v);
                self.low[u] = self.low[u].min(self.low[v]);
            } else if self.component[v] == usize::MAX {
                self.low[u] = self.low[u].min(self.index[v]);
            }
        }
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
