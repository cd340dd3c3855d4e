//! On which lines of a scene's text its paths stand, for an editor that shows what is wrong beside them.

use super::document;

/// Of each path, as problems and warnings have it, the line that it begins on, counted from 1; a path that is not there has
/// the line of the nearest table above it. None where nothing is known.
pub fn lines<'p>(text: &str, paths: impl IntoIterator<Item = &'p str>) -> Vec<Option<usize>> {
    let spans = document::parse(text).map(|table| document::spans(&table)).unwrap_or_default();
    let line = |path: &str| {
        let place = document::place(path, &spans)?;
        Some(text.get(..place)?.matches('\n').count() + 1)
    };
    paths.into_iter().map(|path| of_syntax(path).or_else(|| line(path))).collect()
}

/// Of `line 3, column 5`, the path of what is no TOML.
fn of_syntax(path: &str) -> Option<usize> {
    path.strip_prefix("line ")?.split_once(", column ")?.0.parse().ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const TEXT: &str =
        "name = \"Two\"\n\n[left]\nmass = [\n  1.0,\n  2.0,\n]\n\n[[contact]]\ngap = 1\n[[contact]]\ngap = 2\n";

    #[test]
    fn a_path_has_the_line_of_its_key_or_of_the_table_that_lacks_it() {
        let wanted = [
            ("name", Some(1)),
            ("left.mass", Some(4)),
            ("left.mass[2]", Some(6)),
            ("left.stiffness", Some(3)),
            ("contact[2].gap", Some(12)),
            ("contact[2].law", Some(11)),
            ("right", None),
        ];
        assert_eq!(lines(TEXT, wanted.map(|(path, _)| path)), wanted.map(|(_, line)| line));
    }

    #[test]
    fn what_is_no_toml_has_its_own_line() {
        let text = "name = \"Two\"\nleft = {\n";
        let error = crate::scene::Scene::from_toml(text).unwrap_err();
        assert_eq!(lines(text, error.problems.iter().map(|problem| problem.path.as_str())), [Some(2)]);
    }
}
