//! Rooted trees, for the order conditions (Butcher; Hairer, Nørsett & Wanner I, II.2).

/// A rooted tree: the subtrees at its root.
#[derive(Debug, Clone)]
pub(crate) struct Tree {
    pub branches: Vec<Tree>,
}

impl Tree {
    /// Number of nodes.
    pub(crate) fn order(&self) -> u8 {
        1 + self.branches.iter().map(Tree::order).sum::<u8>()
    }

    /// γ: product of the orders of the tree and all its subtrees (def. II.2.10 there).
    pub(crate) fn density(&self) -> f64 {
        f64::from(self.order()) * self.branches.iter().map(Tree::density).product::<f64>()
    }
}

/// All rooted trees with up to `max_order` nodes.
pub(crate) fn trees(max_order: u8) -> Vec<Tree> {
    let mut list = vec![Tree { branches: vec![] }];
    for order in 2..=max_order {
        let smaller = list.clone();
        forests(&smaller, smaller.len(), order - 1, &mut vec![], &mut list);
    }
    list
}

/// Adds to `list` a root with each multiset of the first `until` trees that has `nodes` nodes.
fn forests(trees: &[Tree], until: usize, nodes: u8, chosen: &mut Vec<Tree>, list: &mut Vec<Tree>) {
    if nodes == 0 {
        list.push(Tree { branches: chosen.clone() });
    }
    for (i, tree) in trees[..until].iter().enumerate() {
        if tree.order() <= nodes {
            chosen.push(tree.clone());
            forests(trees, i + 1, nodes - tree.order(), chosen, list);
            chosen.pop();
        }
    }
}
