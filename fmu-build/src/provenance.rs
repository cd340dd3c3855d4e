//! Which scene the FMU at the default place is of: two scenes may have one name, and one FMU takes the other's place.
//!
//! A note beside the FMU says so. It is not in the FMU, whose bytes do not depend on where the scene lies.

use std::path::{Path, PathBuf};

/// A scene and the note about the FMU that it becomes.
pub struct Provenance {
    note: PathBuf,
    text: String,
    warning: Option<String>,
}

impl Provenance {
    /// Of a scene with that fingerprint, and of where its FMU goes, before it is there.
    pub fn new(fmu: &Path, scene: &Path, guid: &str) -> Provenance {
        let scene = scene.canonicalize().unwrap_or_else(|_| scene.to_path_buf()).display().to_string();
        let mut note = fmu.as_os_str().to_owned();
        note.push(".scene");
        let note = PathBuf::from(note);
        let old = std::fs::read_to_string(&note).ok().filter(|_| fmu.is_file()).unwrap_or_default();
        let other = old.trim_end().split_once(' ').filter(|old| guid != old.0 && scene != old.1);
        let warning = other.map(|(_, other)| {
            let fmu = fmu.display();
            format!("{fmu} = {scene}: it was {other}, a scene of the same name; another name, or -o, keeps both")
        });
        Provenance { note, text: format!("{guid} {scene}\n"), warning }
    }

    /// Notes the scene; the warning where its FMU has taken the place of that of a scene in another file with other
    /// contents.
    pub fn note(self) -> Option<String> {
        // Without a note there is no warning next time, and nothing else.
        let _ = std::fs::write(self.note, self.text);
        self.warning
    }
}
