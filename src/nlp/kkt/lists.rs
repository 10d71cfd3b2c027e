//! Many short lists in one array.

/// Lists of numbers, one after another; each can shrink, and grow again to what it once was.
#[derive(Debug, Clone, Default)]
pub(super) struct Lists {
    /// Start and length of each list.
    spans: Vec<(u32, u32)>,
    items: Vec<u32>,
}

impl Lists {
    /// Adds a list.
    pub fn add(&mut self, items: impl IntoIterator<Item = u32>) {
        let start = self.items.len();
        self.items.extend(items);
        let length = self.items.len() - start;
        self.spans.push((start as u32, length as u32));
    }

    /// The numbers below `count` in `lists` lists, each in the list that `list_of` says, in order.
    pub fn grouped(lists: usize, count: usize, list_of: impl Fn(usize) -> Option<usize>) -> Self {
        let mut spans = vec![(0, 0); lists];
        for list in (0..count).filter_map(&list_of) {
            spans[list].1 += 1;
        }
        let mut start = 0;
        for span in &mut spans {
            let length = std::mem::replace(span, (start, 0)).1;
            start += length;
        }
        let mut grouped = Self {
            spans,
            items: vec![0; start as usize],
        };
        for item in 0..count {
            if let Some(list) = list_of(item) {
                grouped.push(list, item as u32);
            }
        }
        grouped
    }

    /// As many lists with as much room, nothing in them.
    pub fn emptied(&self) -> Self {
        Self {
            spans: self.spans.iter().map(|&(start, _)| (start, 0)).collect(),
            items: vec![0; self.items.len()],
        }
    }

    pub fn get(&self, list: usize) -> &[u32] {
        let (start, length) = self.spans[list];
        &self.items[start as usize..][..length as usize]
    }

    /// A list to be put in another order.
    pub fn get_mut(&mut self, list: usize) -> &mut [u32] {
        let (start, length) = self.spans[list];
        &mut self.items[start as usize..][..length as usize]
    }

    /// Empties a list.
    pub fn clear(&mut self, list: usize) {
        self.spans[list].1 = 0;
    }

    /// Adds an item to a list that once was longer.
    pub fn push(&mut self, list: usize, item: u32) {
        let (start, length) = self.spans[list];
        let place = start + length;
        let next = self.spans.get(list + 1);
        debug_assert!(
            next.is_none_or(|&(next, _)| place < next),
            "the list was never longer"
        );
        self.items[place as usize] = item;
        self.spans[list].1 += 1;
    }

    /// Leaves in a list what `keep` says yes to.
    pub fn retain(&mut self, list: usize, mut keep: impl FnMut(u32) -> bool) {
        let (start, length) = &mut self.spans[list];
        let items = &mut self.items[*start as usize..][..*length as usize];
        let mut kept = 0;
        for from in 0..items.len() {
            let item = items[from];
            if keep(item) {
                items[kept] = item;
                kept += 1;
            }
        }
        *length = kept as u32;
    }
}

#[cfg(test)]
mod tests {
    use super::Lists;

    #[test]
    fn lists_shrink_and_grow_in_their_place() {
        let mut lists = Lists::default();
        lists.add([1, 2, 3, 4]);
        lists.add([]);
        lists.add([5, 6]);
        lists.retain(0, |item| item % 2 == 0);
        assert_eq!(lists.get(0), [2, 4]);
        lists.push(0, 7);
        assert_eq!(lists.get(0), [2, 4, 7]);
        lists.clear(2);
        assert!(lists.get(1).is_empty() && lists.get(2).is_empty());
        let mut emptied = lists.emptied();
        assert!(emptied.get(0).is_empty());
        emptied.push(2, 8);
        assert_eq!(emptied.get(2), [8]);
    }

    #[test]
    fn numbers_are_grouped_in_order() {
        let of = |item| [Some(2), None, Some(0), Some(2), Some(0)][item];
        let mut lists = Lists::grouped(3, 5, of);
        assert_eq!(
            [lists.get(0), lists.get(1), lists.get(2)],
            [&[2, 4][..], &[], &[0, 3]]
        );
        lists.get_mut(2).reverse();
        assert_eq!(lists.get(2), [3, 0]);
    }
}
