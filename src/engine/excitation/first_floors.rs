//! Where the floors of each building begin among those of all, and how that is saved.

use crate::structure::BuildingId;
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

/// How many floors stand on the left of each building of a row.
///
/// Saved states of two buildings have one number for it, the floors of the left one, which are never 0. In those of any other
/// row a 0 stands there, and then the numbers of all buildings.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FirstFloors(Vec<usize>);

impl FirstFloors {
    /// Of buildings with so many floors, from left to right.
    pub(crate) fn of(floors: &[usize]) -> FirstFloors {
        let before = |sum: &mut usize, floors: &usize| Some(std::mem::replace(sum, *sum + floors));
        FirstFloors(floors.iter().scan(0, before).collect())
    }

    /// The number of a floor among all, if there can be such a one: how many the last building has is not known here.
    pub(crate) fn place(&self, id: BuildingId, floor: usize) -> Option<usize> {
        let place = self.0.get(id.index())?.checked_add(floor)?;
        self.0.get(id.index() + 1).is_none_or(|next| place < *next).then_some(place)
    }
}

impl Serialize for FirstFloors {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0[..] {
            [0, second] if second > 0 => second.serialize(serializer),
            _ => (0_usize, &self.0).serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for FirstFloors {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<FirstFloors, D::Error> {
        // Texts say themselves which of both they have.
        match deserializer.is_human_readable() {
            true => deserializer.deserialize_any(Reader),
            false => deserializer.deserialize_tuple(2, Reader),
        }
    }
}

struct Reader;

impl<'de> Visitor<'de> for Reader {
    type Value = FirstFloors;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the floors of the left building, or 0 and a list")
    }

    fn visit_u64<E: Error>(self, second: u64) -> Result<FirstFloors, E> {
        let second = usize::try_from(second).map_err(|_| E::custom("too many floors"))?;
        Ok(FirstFloors(vec![0, second]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<FirstFloors, A::Error> {
        let missing = || A::Error::invalid_length(0, &self);
        Ok(FirstFloors(match numbers.next_element()?.ok_or_else(missing)? {
            0 => numbers.next_element()?.ok_or_else(missing)?,
            second => vec![0, second],
        }))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn two_buildings_are_saved_as_one_number() {
        assert_eq!(postcard::to_allocvec(&FirstFloors::of(&[3, 5])).unwrap(), [3]);
    }

    #[test]
    fn what_is_read_is_what_was_saved() {
        for floors in [&[3, 5][..], &[3], &[3, 0], &[2, 4, 6], &[1, 1, 1, 200]] {
            let first = FirstFloors::of(floors);
            let bytes = postcard::to_allocvec(&(&first, 7_u8)).unwrap();
            assert_eq!(postcard::from_bytes::<(FirstFloors, u8)>(&bytes).unwrap(), (first.clone(), 7));
            let text = serde_json::to_value(&first).unwrap();
            assert_eq!(serde_json::from_value::<FirstFloors>(text).unwrap(), first);
        }
    }

    #[test]
    fn floors_of_one_building_are_none_of_the_next() {
        let first = FirstFloors::of(&[2, 3]);
        let [left, right] = [0, 1].map(BuildingId::new);
        let places = [first.place(left, 1), first.place(left, 2), first.place(right, 0), first.place(right, 2)];
        assert_eq!(places, [Some(1), None, Some(2), Some(4)]);
        assert_eq!(first.place(BuildingId::new(2), 0), None);
    }
}
