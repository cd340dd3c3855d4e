//! Files that a command writes: none of them may be one that it reads, or take the place of another.

use pounding::record::RecordFile;
use pounding::scene::Scene;
use std::path::{Path, PathBuf};

/// A file that is read, and what messages call it.
pub type Source = (&'static str, PathBuf);

/// The scene of a file, and its record: one that has been given to it, or one that it names, relative to its folder.
pub fn sources(file: &Path, scene: &Scene, given: Option<&Path>) -> Vec<Source> {
    let named = || Some(file.parent().unwrap_or(Path::new("")).join(scene.ground.record.as_ref()?));
    let record = given.map(Path::to_path_buf).or_else(named);
    let record = record.map(|path| ("record", RecordFile::place(&path).0));
    std::iter::once(("scene", file.to_path_buf())).chain(record).collect()
}

/// Refuses to write over what is read, and two outputs in one file; an output is an option and its path.
///
/// # Errors
/// The first output that cannot be.
pub fn check(sources: &[Source], outputs: &[(&str, Option<&Path>)]) -> Result<(), String> {
    let outputs: Vec<(&str, &Path)> = outputs.iter().filter_map(|(option, path)| Some((*option, (*path)?))).collect();
    for (i, (option, path)) in outputs.iter().enumerate() {
        if let Some((what, _)) = sources.iter().find(|(_, source)| is_same_file(source, path)) {
            let shown = path.display();
            return Err(format!("{shown}: this is the {what} itself, which stays as it is; expected another name"));
        }
        if let Some((other, _)) = outputs.iter().take(i).find(|(_, other)| is_same_file(other, path)) {
            let shown = path.display();
            return Err(format!("{option} {shown}: this is the file of {other}; expected another name"));
        }
    }
    Ok(())
}

/// Whether two paths lead to one file, by whatever spelling or link, or would if it were there. A device is no file: nothing
/// in it is lost.
pub fn is_same_file(one: &Path, other: &Path) -> bool {
    match (one.metadata(), other.metadata()) {
        (Ok(there), Ok(_)) => there.is_file() && same_file::is_same_file(one, other).unwrap_or(false),
        (Err(_), Err(_)) => place(one).is_some_and(|place_of_one| Some(place_of_one) == place(other)),
        _ => false,
    }
}

/// Where a file will be that is not there yet.
fn place(path: &Path) -> Option<PathBuf> {
    let folder = path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."));
    Some(folder.canonicalize().ok()?.join(path.file_name()?))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::{Source, check, is_same_file};
    use std::path::{Path, PathBuf};

    /// A folder of a test, with a file in it.
    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("pounding-{}-{name}", std::process::id()));
        std::fs::create_dir_all(folder.join("below")).unwrap();
        std::fs::write(folder.join("s.toml"), "mine").unwrap();
        folder
    }

    #[test]
    fn a_file_is_the_same_by_every_spelling_and_link() {
        let folder = folder("spellings");
        let file = folder.join("s.toml");
        std::fs::hard_link(&file, folder.join("hard.toml")).unwrap();
        let mut same = vec!["s.toml", "./s.toml", "below/../s.toml", "hard.toml"];
        if cfg!(unix) {
            #[cfg(unix)]
            std::os::unix::fs::symlink("s.toml", folder.join("soft.toml")).unwrap();
            same.push("soft.toml");
        }
        for name in same {
            assert!(is_same_file(&file, &folder.join(name)), "{name}");
        }
        std::fs::write(folder.join("copy.toml"), "mine").unwrap();
        for name in ["copy.toml", "new.toml", "below/s.toml"] {
            assert!(!is_same_file(&file, &folder.join(name)), "{name}");
        }
        // Where nothing is yet.
        assert!(is_same_file(&folder.join("new.csv"), &folder.join("below/../new.csv")));
        assert!(!is_same_file(&folder.join("new.csv"), &folder.join("below/new.csv")));
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn what_is_read_and_what_is_written_are_told() {
        let folder = folder("told");
        let (scene, csv) = (folder.join("s.toml"), folder.join("a.csv"));
        let sources: [Source; 1] = [("scene", scene.clone())];
        let refusal =
            |impacts: &Path| check(&sources, &[("--csv", Some(&csv)), ("--html", None), ("--impacts", Some(impacts))]);
        assert_eq!(refusal(&folder.join("b.csv")), Ok(()));
        let told = refusal(&scene).unwrap_err();
        assert_eq!(
            told,
            format!("{}: this is the scene itself, which stays as it is; expected another name", scene.display())
        );
        let told = refusal(&csv).unwrap_err();
        assert_eq!(told, format!("--impacts {}: this is the file of --csv; expected another name", csv.display()));
        std::fs::remove_dir_all(folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_device_holds_nothing_that_could_be_lost() {
        let null = Path::new("/dev/null");
        assert_eq!(check(&[], &[("--csv", Some(null)), ("--impacts", Some(null))]), Ok(()));
    }
}
