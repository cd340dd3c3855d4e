//! Any bytes as a record file: read or refused, and what is read is what [`Record`] promises.

use pounding::record::{MOST_PROBLEMS, Record};

/// Panics where the parser of the format that the name stands for does what it should not.
pub fn check(name: &str, bytes: &[u8]) {
    let record = match Record::parse(name, bytes) {
        Ok(record) => record,
        Err(error) => {
            assert!((1..=MOST_PROBLEMS + 1).contains(&error.problems.len()), "{error}");
            assert!(error.problems.iter().all(|line| !line.is_empty() && !line.contains('\n')), "{error:?}");
            return;
        }
    };
    let Record { times, accelerations, .. } = &record;
    assert!(times.len() >= 2 && times.len() == accelerations.len());
    assert!(times.iter().chain(accelerations).all(|number| number.is_finite()));
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "times increase");
    assert!(record.peak().is_finite());
    // No sample from nowhere: each takes two characters at least, a digit and what sets it off.
    assert!(2 * times.len() <= bytes.len() + 1);
}
