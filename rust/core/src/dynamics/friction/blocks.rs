//! Pairs whose frictions depend on one another: the strongly connected components, each after those on which
//! it depends (R. Tarjan, *Depth-first search and linear graph algorithms*, SIAM J. Comput. 1 (1972) 146).

use super::problem::FrictionProblem;

/// Depth-first search.
struct Search<'a> {
    problem: &'a FrictionProblem<'a>,
    /// Order of the visits, 0 before a visit.
    visited: Vec<usize>,
    lowest: Vec<usize>,
    stack: Vec<usize>,
    is_open: Vec<bool>,
    count: usize,
    blocks: Vec<Vec<usize>>,
}

impl FrictionProblem<'_> {
    /// The pairs in blocks; each block depends only on itself and on those before it.
    pub(super) fn blocks(&self) -> Vec<Vec<usize>> {
        let n = self.pairs.len();
        let mut search = Search {
            problem: self,
            visited: vec![0; n],
            lowest: vec![0; n],
            stack: Vec::new(),
            is_open: vec![false; n],
            count: 0,
            blocks: Vec::new(),
        };
        for pair in 0..n {
            if search.visited[pair] == 0 {
                search.visit(pair);
            }
        }
        search.blocks
    }

    /// Whether the reaction of a pair depends on the friction of another. Where it does not, its slope is
    /// exactly 0.
    fn depends(&self, pair: usize, on: usize) -> bool {
        self.pairs[pair].slopes[on] != [0.0; 2]
    }

    /// The problem of one block, given the friction of all pairs before it.
    pub(super) fn block(&self, block: &[usize], friction: &[f64]) -> Self {
        let mut earlier_friction = friction.to_vec();
        for &pair in block {
            earlier_friction[pair] = 0.0;
        }
        let pairs = block.iter().map(|&pair| {
            let mut pair_in_block = self.pairs[pair].clone();
            pair_in_block.base = self.reaction(pair, &earlier_friction);
            pair_in_block.slopes = block.iter().map(|&on| self.pairs[pair].slopes[on]).collect();
            pair_in_block
        });
        Self { pairs: pairs.collect(), cancel: self.cancel }
    }
}

impl Search<'_> {
    fn visit(&mut self, pair: usize) {
        self.count += 1;
        (self.visited[pair], self.lowest[pair]) = (self.count, self.count);
        self.stack.push(pair);
        self.is_open[pair] = true;
        for on in 0..self.problem.pairs.len() {
            if !self.problem.depends(pair, on) {
                continue;
            }
            if self.visited[on] == 0 {
                self.visit(on);
                self.lowest[pair] = self.lowest[pair].min(self.lowest[on]);
            } else if self.is_open[on] {
                self.lowest[pair] = self.lowest[pair].min(self.visited[on]);
            }
        }
        if self.lowest[pair] != self.visited[pair] {
            return;
        }
        let mut block = Vec::new();
        while let Some(member) = self.stack.pop() {
            self.is_open[member] = false;
            block.push(member);
            if member == pair {
                break;
            }
        }
        block.reverse();
        self.blocks.push(block);
    }
}
