//! `outputs.numbers_only`: the variables of an FMU for importers that read each of them as a number.

use super::part::ONE;
use super::table::{Table, Type};
use crate::scene::Scene;

impl Table {
    /// The variables as the FMU of a scene declares them: all of [`Table::new`], or, where the scene wants numbers only, counts
    /// and flags as numbers and no texts.
    ///
    /// ```
    /// use pounding::scene::Scene;
    /// use pounding::variables::{Table, Type};
    ///
    /// let scene = Scene::from_toml(
    ///     "name = \"Mast\"\noutputs = { numbers_only = true }\nground = { record = \"a.csv\" }\n\
    ///     left = { mass = [1e3], stiffness = [1e5], damping = { ratio = 0.0 } }",
    /// )?;
    /// let (all, declared) = (Table::new(&scene), Table::of_fmu(&scene));
    /// let is_text = |table: &Table| table.rows.iter().any(|row| row.name == "ground.record");
    /// assert!(is_text(&all) && !is_text(&declared));
    /// assert!(declared.rows.iter().all(|row| matches!(row.ty, Type::Real(_))));
    /// # Ok::<(), pounding::scene::SceneError>(())
    /// ```
    pub fn of_fmu(scene: &Scene) -> Table {
        let mut table = Table::new(scene);
        if scene.numbers_only {
            table.keep_numbers();
        }
        table
    }

    /// The last variable takes the place of the text, so that all others keep their value references.
    fn keep_numbers(&mut self) {
        if let Some(text) = self.rows.iter().position(|row| row.ty == Type::String) {
            self.rows.swap_remove(text);
        }
        for row in &mut self.rows {
            match row.ty {
                Type::Boolean => row.between(0.0, 1.0).ty = ONE,
                Type::Integer => row.ty = ONE,
                Type::Real(_) | Type::String => {}
            }
        }
    }
}
