//! The laws of contact, to choose from.

use crate::message::{Answer, Refusal};
use pounding::contact::LawKind;
use serde_json::{Value, json};

/// Name, force and known defect of each.
pub fn all() -> Result<Answer, Refusal> {
    let law = |kind: &LawKind| {
        let info = kind.info();
        json!({ "name": info.name, "force": info.force, "returns": info.returns, "defect": info.defect })
    };
    Answer::json(&LawKind::ALL.iter().map(law).collect::<Vec<Value>>(), Vec::new())
}
