//! What a description says, in one form for both versions. `check` has it read by an importer that is not ours
//! (`importer/description.rs`); the run after building needs little of it, and reads that here.

use crate::sight;
use anyhow::{Context, Result};
use pounding::FmiVersion;
use roxmltree::{Document, Node};

/// What is read of a description.
pub struct Description {
    pub version: FmiVersion,
    pub name: String,
    /// Of co-simulation.
    pub identifier: String,
    /// The GUID, or `instantiationToken`.
    pub token: String,
    pub experiment: Experiment,
    pub variables: Vec<Variable>,
    pub outputs: Vec<Unknown>,
    pub initial_unknowns: Vec<Unknown>,
    /// Where this is FMI 2.0, whether it needs memory functions of the importer.
    pub needs_memory: bool,
    /// What the importer finds wrong.
    pub problems: Vec<String>,
}

/// The default experiment, its numbers as texts.
#[derive(Default)]
pub struct Experiment {
    pub start: Option<String>,
    pub stop: Option<String>,
    pub step: Option<String>,
    pub tolerance: Option<String>,
}

/// A variable, its numbers as texts.
#[derive(Clone)]
pub struct Variable {
    pub name: String,
    pub reference: u32,
    pub description: Option<String>,
    pub causality: Causality,
    pub initial: Option<Initial>,
    pub kind: Kind,
    pub min: Option<String>,
    pub max: Option<String>,
    pub nominal: Option<String>,
    pub start: Option<String>,
    /// Of FMI 3.0: it is exchanged within steps.
    pub has_updates: bool,
    /// It changes between events.
    pub is_continuous: bool,
}

/// What a variable is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    Parameter,
    CalculatedParameter,
    StructuralParameter,
    Input,
    Output,
    Local,
    Independent,
}

/// How the first value of a variable comes about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Initial {
    Exact,
    Approx,
    Calculated,
}

/// The type of a variable: those that FMUs of ours have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Real,
    Integer,
    Boolean,
    String,
    Other(&'static str),
}

/// What is computed, and from what, by the numbers that the version gives to variables there.
pub struct Unknown {
    pub number: u32,
    pub dependencies: Vec<u32>,
}

pub const NO_INTERFACE: &str = "the FMU has no co-simulation interface";

impl Description {
    /// As much of a description of ours as running the FMU takes.
    pub fn for_a_run(text: &str) -> Result<Description> {
        let document = Document::parse(text)?;
        let root = document.root_element();
        let version = sight::version(text);
        let token = match version {
            FmiVersion::V2 => "guid",
            FmiVersion::V3 => "instantiationToken",
        };
        let inside = |name: &'static str| root.children().find(|child| child.has_tag_name(name));
        let experiment = inside("DefaultExperiment");
        let number = |name| experiment.and_then(|experiment| experiment.attribute(name)).map(str::to_owned);
        let variables = inside("ModelVariables").context("the FMU has no variables")?;
        Ok(Description {
            version,
            name: needed(root, "modelName")?,
            identifier: needed(inside("CoSimulation").context(NO_INTERFACE)?, "modelIdentifier")?,
            token: needed(root, token)?,
            experiment: Experiment {
                start: number("startTime"),
                stop: number("stopTime"),
                step: number("stepSize"),
                tolerance: number("tolerance"),
            },
            variables: variables.children().filter(Node::is_element).map(variable).collect::<Result<_>>()?,
            outputs: Vec::new(),
            initial_unknowns: Vec::new(),
            needs_memory: false,
            problems: Vec::new(),
        })
    }

    /// The variable of a number in the model structure.
    pub fn variable(&self, number: u32) -> Option<&Variable> {
        match self.version {
            FmiVersion::V2 => self.variables.get(usize::try_from(number).ok()?.checked_sub(1)?),
            FmiVersion::V3 => self.variables.iter().find(|variable| variable.reference == number),
        }
    }
}

fn needed(node: Node<'_, '_>, name: &str) -> Result<String> {
    let text = node.attribute(name).with_context(|| format!("{} has no {name}", node.tag_name().name()))?;
    Ok(text.to_owned())
}

/// In FMI 3.0 the type is the element, in FMI 2.0 one within it.
fn variable(node: Node<'_, '_>) -> Result<Variable> {
    let of_type = if node.has_tag_name("ScalarVariable") { node.first_element_child().unwrap_or(node) } else { node };
    Ok(Variable {
        name: needed(node, "name")?,
        reference: needed(node, "valueReference")?.parse()?,
        description: None,
        causality: match node.attribute("causality") {
            Some("parameter") => Causality::Parameter,
            Some("calculatedParameter") => Causality::CalculatedParameter,
            Some("structuralParameter") => Causality::StructuralParameter,
            Some("input") => Causality::Input,
            Some("output") => Causality::Output,
            Some("independent") => Causality::Independent,
            _ => Causality::Local,
        },
        initial: None,
        kind: match of_type.tag_name().name() {
            "Real" | "Float64" => Kind::Real,
            "Integer" | "Int32" => Kind::Integer,
            "Boolean" => Kind::Boolean,
            _ => Kind::String,
        },
        min: None,
        max: None,
        nominal: None,
        start: None,
        has_updates: false,
        is_continuous: false,
    })
}
