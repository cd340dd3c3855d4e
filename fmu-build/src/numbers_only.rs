//! `--numbers-only`: what a scene says by the key `outputs.numbers_only`, said for it.

use anyhow::Result;
use pounding::description::Package;
use pounding::scene::Scene;
use toml_edit::{DocumentMut, value};

/// The same with that key in the text of the scene.
///
/// # Errors
/// A text in which there is no place for it.
pub fn numbers_only(package: &Package) -> Result<Package> {
    let mut document: DocumentMut = package.scene_text.parse()?;
    document["outputs"]["numbers_only"] = value(true);
    let scene_text = document.to_string();
    let scene = Scene::from_toml(&scene_text)?;
    Ok(Package { scene_text, scene, record: package.record.clone() })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::path::Path;

    /// However the scene writes its outputs, and whatever it says of them, the rest of the text stays.
    #[test]
    fn the_key_is_set_and_nothing_else() {
        let scene =
            "# A mast.\nname = \"A\"\nleft = { mass = [1.0], stiffness = [9.0], damping = { ratio = 0.1 } } # stiff\n";
        for outputs in [
            "",
            "outputs = { energy = true }\n",
            "outputs.energy = true\n",
            "[outputs]\nenergy = true # both\n",
            "[outputs]\nenergy = true\nnumbers_only = false\n",
            "[outputs]\nenergy = true\n[solver]\nrelative_tolerance = 1e-9\n",
        ] {
            let text = format!("{scene}{outputs}");
            let package = Package::from_scene_text(text.clone(), Path::new("")).unwrap();
            let made = numbers_only(&package).unwrap();
            let mut expected = package.scene.clone();
            expected.numbers_only = true;
            assert_eq!(made.scene, expected, "{outputs}");
            assert_eq!(Scene::from_toml(&made.scene_text), Ok(expected));
            for line in text.lines().filter(|line| !line.contains("outputs") && !line.contains("numbers_only")) {
                assert!(made.scene_text.contains(line), "{line} in {}", made.scene_text);
            }
        }
    }
}
