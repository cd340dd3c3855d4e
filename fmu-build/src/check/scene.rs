//! The description of an FMU beside that of the scene inside it, which is written anew: any difference is a finding.

use crate::archive::Unpacked;
use crate::sight::version;
use pounding::description::{Package, TOOL, guid_of};
use roxmltree::{Attribute, Document, Node};
use std::collections::HashMap;
use std::path::Path;

/// Everything that is not as the scene has it. What another version of this program writes nobody knows here, but the
/// GUID tells whether it has been changed. What is no XML is for the importer to say.
pub fn differences(fmu: &Unpacked, text: &str) -> Vec<String> {
    let (resources, Ok(found)) = (fmu.path("resources"), Document::parse(text)) else { return Vec::new() };
    let root = found.root_element();
    if root.attribute("generationTool") != Some(TOOL) {
        return changes(&resources, text, root);
    }
    let package = match Package::from_resources(&resources) {
        Ok(package) => package,
        Err(error) => return error.problems.iter().map(|problem| format!("resources/scene.toml: {problem}")).collect(),
    };
    compared(root, &package.model_description(version(text)))
}

/// Everything in a description that is not as in the text that is expected.
fn compared(found: Node, expected: &str) -> Vec<String> {
    let mut findings = Vec::new();
    match Document::parse(expected) {
        Ok(expected) => compare(found, expected.root_element(), "modelDescription.xml", &mut findings),
        Err(error) => findings.push(format!("the description of the scene cannot be read: {error}")),
    }
    findings
}

/// A finding where the GUID is not that of the description, the scene and the record.
fn changes(resources: &Path, text: &str, root: Node) -> Vec<String> {
    let guid = root.attribute("guid").or(root.attribute("instantiationToken")).unwrap_or_default();
    let files = std::fs::read_dir(resources).into_iter().flatten().flatten().map(|file| file.path());
    let (scenes, records): (Vec<_>, Vec<_>) = files.partition(|file| file.ends_with("scene.toml"));
    let [scene, record] = [scenes, records].map(|files| files.first().and_then(|file| std::fs::read(file).ok()));
    let scene = String::from_utf8(scene.unwrap_or_default()).unwrap_or_default();
    let expected = guid_of(&text.replacen(guid, "", 1), &scene, &record.unwrap_or_default());
    let finding = || format!("GUID {guid:?}; expected {expected:?}: description, scene or record have been changed");
    Vec::from_iter((guid != expected).then(finding))
}

/// Compares an element, which stands at a place, and all within it.
fn compare<'a, 'd>(found: Node<'a, 'd>, expected: Node<'a, 'd>, place: &str, findings: &mut Vec<String>) {
    for attribute in attributes(expected) {
        let (name, value) = (attribute.name(), attribute.value());
        match found.attribute(name) {
            None => findings.push(format!("{place}: no {name}; expected {value:?}")),
            Some(other) if other != value => findings.push(format!("{place}: {name} {other:?}; expected {value:?}")),
            Some(_) => {}
        }
    }
    let more = attributes(found).filter(|attribute| !expected.has_attribute(attribute.name()));
    findings.extend(more.map(|more| format!("{place}: {} {:?}; expected none", more.name(), more.value())));

    let (there, wanted) = (children(found), children(expected));
    let by_name = |list: &[(String, Node<'a, 'd>)]| list.iter().cloned().collect::<HashMap<_, _>>();
    let (known, ours) = (by_name(&there), by_name(&wanted));
    for (name, expected) in &wanted {
        match known.get(name) {
            Some(found) => compare(*found, *expected, &format!("{place}/{name}"), findings),
            None => findings.push(format!("{place}: no {name}")),
        }
    }
    let (there, strange): (Vec<_>, Vec<_>) =
        there.iter().map(|(name, _)| name).partition(|name| ours.contains_key(*name));
    findings.extend(strange.iter().map(|name| format!("{place}: {name}; expected none")));
    let wanted = wanted.iter().map(|(name, _)| name).filter(|name| known.contains_key(*name));
    let end = String::from("the end");
    let mut pairs = there.into_iter().chain([&end]).zip(wanted.chain([&end]));
    if let Some((name, expected)) = pairs.find(|(name, expected)| name != expected) {
        findings.push(format!("{place}: {name} where {expected} is expected"));
    }
}

/// Attributes of other namespaces are others' business.
fn attributes<'a, 'd>(node: Node<'a, 'd>) -> impl Iterator<Item = Attribute<'a, 'd>> {
    node.attributes().filter(|attribute| attribute.namespace().is_none())
}

/// The elements in an element, and the texts between them that are not blank, by what tells them from each other.
fn children<'a, 'd>(node: Node<'a, 'd>) -> Vec<(String, Node<'a, 'd>)> {
    let is_blank = |node: &Node| node.text().unwrap_or_default().trim().is_empty();
    let children = node.children().filter(|child| child.is_element() || (child.is_text() && !is_blank(child)));
    let name = |child: &Node| {
        let own = ["name", "valueReference", "index"].iter().find_map(|key| child.attribute(*key));
        let tag = if child.is_text() { "a text" } else { child.tag_name().name() };
        own.map_or(tag.to_owned(), |own| format!("{tag} {own}"))
    };
    children.map(|child| (name(&child), child)).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use pounding::FmiVersion;

    const SCENE: &str = "name = \"A\"\noutputs.peaks = false\ninputs.floor_forces = true\n\
        left = { mass = [1.0], stiffness = [9.0], damping = { ratio = 0.1 } }\n\
        contact = [{ left_floor = 1, wall = \"right\", gap = 0.1, law = \"linear\", stiffness = 1e3 }]";

    /// Everything found in changes of a description, each of which must lead to a finding that says so.
    fn each_is_found(changes: impl Fn(Node, &mut dyn FnMut(std::ops::Range<usize>, String, &str))) {
        for version in FmiVersion::ALL {
            let package = Package::from_scene_text(SCENE.to_owned(), Path::new("")).unwrap();
            let good = package.model_description(version);
            let findings = |text: &str| compared(Document::parse(text).unwrap().root_element(), &good);
            assert_eq!(findings(&good), [""; 0]);
            let mut count = 0;
            for node in Document::parse(&good).unwrap().descendants().filter(Node::is_element) {
                changes(node, &mut |range, new, said| {
                    let mut text = good.clone();
                    text.replace_range(range, &new);
                    let found = findings(&text);
                    assert!(found.iter().any(|finding| finding.contains(said)), "{text}\n{found:#?}\nno {said}");
                    count += 1;
                });
            }
            assert!(count > 50, "{count}");
        }
    }

    #[test]
    fn no_attribute_is_changed_left_out_or_added_unseen() {
        each_is_found(|node, change| {
            for attribute in node.attributes() {
                let (name, value) = (attribute.name(), attribute.value());
                // Some of them tell elements apart.
                let is_key = ["name", "valueReference", "index"].contains(&name) && node.parent_element().is_some();
                let said = |said: String| if is_key { "expected".to_owned() } else { said };
                change(attribute.range_value(), format!("{value}1"), &said(format!("{name} \"{value}1\"; expected")));
                change(attribute.range(), String::new(), &said(format!("no {name}; expected")));
            }
            let behind_tag = node.range().start + 1 + node.tag_name().name().len();
            change(behind_tag..behind_tag, " colour=\"red\"".to_owned(), "colour \"red\"; expected none");
        });
    }

    #[test]
    fn no_element_is_left_out_doubled_moved_or_filled_unseen() {
        let text = |node: Node| node.document().input_text()[node.range()].to_owned();
        each_is_found(|node, change| {
            if node.parent_element().is_none() {
                return;
            }
            let end = node.range().end;
            change(node.range(), String::new(), ": no ");
            change(node.range(), "rubbish".to_owned(), ": a text; expected none");
            change(end..end, text(node), "is expected");
            if let Some(next) = node.next_sibling_element() {
                change(node.range().start..next.range().end, text(next) + &text(node), " where ");
            }
        });
    }
}
