//! An FMU of either version as a master sees it: its resources in a directory, instances by the linked functions, a logger.
//! Each test uses a part of it.
#![allow(dead_code, unused_imports, clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod events;
mod instance;
mod instantiation;
pub mod linked;
mod log;
pub mod scenes;
mod state;

use fmi::model_description::fmi2::{Causality, ModelDescription, VariableType};
pub use instance::Instance;
pub use instantiation::{Arguments, c, uri};
pub use linked::*;
pub use log::{Line, Log, Turn, environment, note_2, note_3};
use pounding::FmiVersion;
use pounding::description::Package;
use pounding::variables::{Slot, Table, Type};
pub use scenes::{COLLAPSE, CORRECTED, LINKED, NO_CONTACT, RECORD_SCENE, RICH, SCENE, UNEVEN, YIELDING, record};
use std::ops::Deref;
use std::path::PathBuf;
use std::sync::Arc;
use tempfile::TempDir;

/// An unpacked FMU.
pub struct Fmu {
    pub version: FmiVersion,
    /// Called instantiation token in FMI 3.0.
    pub guid: String,
    unpacked: Arc<Unpacked>,
}

/// The resources of a scene, and what they are read as.
pub struct Unpacked {
    pub directory: TempDir,
    pub package: Package,
    pub table: Table,
    /// In FMI 2.0; that of FMI 3.0 says the same (`description/fmi3.rs`).
    pub description: ModelDescription,
}

impl Fmu {
    /// One of FMI 2.0; a record that the scene names is [`record`].
    pub fn new(scene: &str) -> Fmu {
        Fmu::with_record(scene, record().as_bytes())
    }

    /// The same with another record in CSV.
    pub fn with_record(scene: &str, record: &[u8]) -> Fmu {
        Fmu::of(FmiVersion::V2, Arc::new(Unpacked::new(scene, record)))
    }

    /// One of FMI 3.0.
    pub fn v3(scene: &str) -> Fmu {
        let [_, fmu] = Fmu::both(scene);
        fmu
    }

    /// One of each version, in the same directory.
    pub fn both(scene: &str) -> [Fmu; 2] {
        let unpacked = Arc::new(Unpacked::new(scene, record().as_bytes()));
        FmiVersion::ALL.map(|version| Fmu::of(version, Arc::clone(&unpacked)))
    }

    fn of(version: FmiVersion, unpacked: Arc<Unpacked>) -> Fmu {
        Fmu { version, guid: unpacked.package.guid(version), unpacked }
    }

    /// What is not the same in both versions: that of FMI 2.0, that of FMI 3.0.
    pub fn either<T>(&self, of_2: T, of_3: T) -> T {
        match self.version {
            FmiVersion::V2 => of_2,
            FmiVersion::V3 => of_3,
        }
    }
}

impl Deref for Fmu {
    type Target = Unpacked;

    fn deref(&self) -> &Unpacked {
        &self.unpacked
    }
}

impl Unpacked {
    fn new(scene: &str, record: &[u8]) -> Unpacked {
        let directory = TempDir::new().unwrap();
        let resources = directory.path().join("resources");
        std::fs::create_dir(&resources).unwrap();
        std::fs::write(resources.join("scene.toml"), scene).unwrap();
        if scene.contains("record =") {
            std::fs::write(resources.join("record.csv"), record).unwrap();
        }
        let package = Package::from_resources(&resources).unwrap();
        let description = ModelDescription::from_string(&package.model_description(FmiVersion::V2)).unwrap();
        Unpacked { directory, table: Table::of_fmu(&package.scene), package, description }
    }

    pub fn resources(&self) -> PathBuf {
        self.directory.path().join("resources")
    }

    /// The value reference of a variable, or of the time, which is one in FMI 3.0.
    pub fn vr(&self, name: &str) -> u32 {
        match self.description.variable_by_name(name) {
            Err(_) if name == "time" => self.table.time_reference(),
            variable => variable.unwrap_or_else(|_| panic!("no variable {name}")).valueReference,
        }
    }

    pub fn vrs<const N: usize>(&self, names: [&str; N]) -> [u32; N] {
        names.map(|name| self.vr(name))
    }

    /// Names of the variables of a causality that are numbers.
    pub fn reals(&self, causality: &Causality) -> Vec<String> {
        let is_real = |ty: &VariableType| matches!(ty, VariableType::Real { .. });
        let variables = self.description.modelVariables.iter();
        let reals = variables.filter(|v| v.causality == *causality && is_real(&v.variableType));
        reals.map(|v| v.name.clone()).collect()
    }

    /// The value references of all outputs of a type.
    pub fn outputs(&self, is_type: fn(Type) -> bool) -> Vec<u32> {
        let rows = self.table.iter().filter(|(_, row)| matches!(row.slot, Slot::Output(_)) && is_type(row.ty));
        rows.map(|(reference, _)| reference).collect()
    }
}
