//! The equations that determine each unknown, and their order: the fine Dulmage-Mendelsohn decomposition of
//! a square system (Dulmage & Mendelsohn 1958; Pothen & Fan 1990). Each node represents several scalars.

/// Unknowns that must be solved together, with their equations.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct Block {
    /// Indices of unknowns.
    pub unknowns: Vec<usize>,
    /// Indices of equations.
    pub equations: Vec<usize>,
}

/// Structure of a system: the unknowns in each equation.
#[derive(Debug, Clone, Default)]
pub(crate) struct Pattern {
    /// Number of scalars of each unknown.
    pub unknown_size: Vec<usize>,
    /// Number of scalars of each equation.
    pub equation_size: Vec<usize>,
    /// For each equation, the unknowns in it.
    pub unknowns_in: Vec<Vec<usize>>,
}

impl Pattern {
    /// Adds an unknown of `size` scalars and returns its index.
    pub(crate) fn add_unknown(&mut self, size: usize) -> usize {
        self.unknown_size.push(size);
        self.unknown_size.len() - 1
    }

    /// Adds an equation of `size` scalars and returns its index.
    pub(crate) fn add_equation(&mut self, size: usize, unknowns: Vec<usize>) -> usize {
        self.equation_size.push(size);
        self.unknowns_in.push(unknowns);
        self.unknowns_in.len() - 1
    }

    /// Blocks in solving order; `None` if the system is not structurally square
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
            // All partners of an equation are in one block, since it contains each of them.
            if let Some(&unknown) = partners.first() {
                blocks[components[unknown]].equations.push(equation);
            }
        }
        Some(blocks)
    }

    /// For every equation, the unknowns to which its scalars are matched (Kuhn's
    /// augmenting paths). `None` unless every scalar is matched.
    fn matching(&self) -> Option<Vec<Vec<usize>>> {
        if self.unknown_size.iter().sum::<usize>() != self.equation_size.iter().sum::<usize>() {
            return None;
        }
        let mut matched_equations: Vec<Vec<usize>> = vec![Vec::new(); self.unknown_size.len()];
        let mut met = Met::new(self.unknown_size.len());
        for equation in 0..self.unknowns_in.len() {
            for _ in 0..self.equation_size[equation] {
                if !self.augment(equation, &mut matched_equations, &mut met) {
                    return None;
                }
                met.forget();
            }
        }
        let mut matched_unknowns = vec![Vec::new(); self.unknowns_in.len()];
        for (unknown, equations) in matched_equations.iter().enumerate() {
            for &equation in equations {
                matched_unknowns[equation].push(unknown);
            }
        }
        Some(matched_unknowns)
    }

    /// Matches one more scalar of an equation along an augmenting path. The path can be as long as
    /// the linkage, so it is kept in a list instead of the thread's stack.
    fn augment(
        &self,
        equation: usize,
        matched_equations: &mut [Vec<usize>],
        met: &mut Met,
    ) -> bool {
        /// An equation on the path: it tries to match its unknown number `trial`, from which its
        /// partner number `slot` would have to move. `reached`: the first unknown met that can be
        /// reached from there.
        struct Search {
            equation: usize,
            trial: usize,
            slot: usize,
            reached: usize,
        }
        let start = |equation| Search { equation, trial: 0, slot: 0, reached: usize::MAX };
        let mut path = vec![start(equation)];
        while let Some(top) = path.last_mut() {
            let Some(&unknown) = self.unknowns_in[top.equation].get(top.trial) else {
                path.pop();
                if let Some(previous) = path.last_mut() {
                    previous.slot += 1;
                }
                continue;
            };
            if top.slot == 0 {
                if let Some(number) = met.number[unknown] {
                    top.trial += 1;
                    if let [.., previous, _] = &mut path[..] {
                        previous.reached = previous.reached.min(number);
                    }
                    continue;
                }
                top.reached = met.add(unknown);
                if matched_equations[unknown].len() < self.unknown_size[unknown] {
                    matched_equations[unknown].push(top.equation);
                    path.pop();
                    for search in path {
                        let unknown = self.unknowns_in[search.equation][search.trial];
                        matched_equations[unknown][search.slot] = search.equation;
                    }
                    return true;
                }
            }
            if let Some(&equation) = matched_equations[unknown].get(top.slot) {
                path.push(start(equation));
            } else {
                let reached = top.reached;
                (top.trial, top.slot) = (top.trial + 1, 0);
                if met.number[unknown] == Some(reached) {
                    met.close(reached);
                } else if let [.., previous, _] = &mut path[..] {
                    previous.reached = previous.reached.min(reached);
                }
            }
        }
        false
    }

    /// Strongly connected components of "the equation that determines `u` contains `v`", numbered
    /// in solving order (Tarjan 1972).
    fn components(&self, matched_unknowns: &[Vec<usize>]) -> Vec<usize> {
        let n = self.unknown_size.len();
        let mut needs = vec![Vec::new(); n];
        for (equation, partners) in matched_unknowns.iter().enumerate() {
            for &unknown in partners {
                needs[unknown].extend(self.unknowns_in[equation].iter().copied());
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

/// The unknowns that the search for an augmenting path has visited.
///
/// Unknowns whose partners do not lead to other unknowns form a closed component, as in Tarjan's algorithm.
/// Later paths cannot pass through them either and skip them. Otherwise the search would go over the whole
/// linkage for each equation.
struct Met {
    /// For each unknown its place in `order`; beyond all places once it is closed.
    number: Vec<Option<usize>>,
    /// The unknowns met by this search and not closed.
    order: Vec<usize>,
}

impl Met {
    fn new(unknowns: usize) -> Self {
        Self { number: vec![None; unknowns], order: Vec::new() }
    }

    fn add(&mut self, unknown: usize) -> usize {
        self.number[unknown] = Some(self.order.len());
        self.order.push(unknown);
        self.order.len() - 1
    }

    /// Closes the unknowns met from this place on.
    fn close(&mut self, from: usize) {
        for unknown in self.order.drain(from..) {
            self.number[unknown] = Some(usize::MAX);
        }
    }

    /// Ends the search.
    fn forget(&mut self) {
        for unknown in self.order.drain(..) {
            self.number[unknown] = None;
        }
    }
}

/// State of Tarjan's algorithm.
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
    /// Visits the unknowns reachable from `root`, depth first. The path can be as long as the
    /// linkage, so it is kept in a list instead of the thread's stack.
    fn visit_from(&mut self, root: usize) {
        // Each unknown on the path, with the number of its `needs` visited so far.
        let mut path = vec![(root, 0)];
        self.enter(root);
        while let Some((u, visited)) = path.last_mut() {
            let u = *u;
            if let Some(&v) = self.needs[u].get(*visited) {
                *visited += 1;
                if self.index[v] == usize::MAX {
                    self.enter(v);
                    path.push((v, 0));
                } else if self.component[v] == usize::MAX {
                    self.low[u] = self.low[u].min(self.index[v]);
                }
                continue;
            }
            path.pop();
            if let Some(&(previous, _)) = path.last() {
                self.low[previous] = self.low[previous].min(self.low[u]);
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

    /// Completes the component whose root is `u`, if `u` is a root.
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
