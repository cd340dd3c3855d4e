//! Which attributes the elements of a description may have. FMI 2.0 has more elements than those of our FMUs, which are
//! not looked at here. Those that FMI 3.0 has more are found: importers have trouble with arrays, clocks and aliases.

use pounding::FmiVersion;
use roxmltree::{Document, Node};

const FMI2: [(&str, &[&str]); 13] = [
    (
        "fmiModelDescription",
        &[
            "fmiVersion",
            "modelName",
            "guid",
            "description",
            "author",
            "version",
            "copyright",
            "license",
            "generationTool",
            "generationDateAndTime",
            "variableNamingConvention",
            "numberOfEventIndicators",
        ],
    ),
    (
        "CoSimulation",
        &[
            "modelIdentifier",
            "needsExecutionTool",
            "canHandleVariableCommunicationStepSize",
            "canInterpolateInputs",
            "maxOutputDerivativeOrder",
            "canRunAsynchronuously",
            "canBeInstantiatedOnlyOncePerProcess",
            "canNotUseMemoryManagementFunctions",
            "canGetAndSetFMUstate",
            "canSerializeFMUstate",
            "providesDirectionalDerivative",
        ],
    ),
    ("Unit", &["name"]),
    ("BaseUnit", &["kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor", "offset"]),
    ("DisplayUnit", &["name", "factor", "offset"]),
    ("Category", &["name", "description"]),
    ("DefaultExperiment", &["startTime", "stopTime", "tolerance", "stepSize"]),
    (
        "ScalarVariable",
        &[
            "name",
            "valueReference",
            "description",
            "causality",
            "variability",
            "initial",
            "canHandleMultipleSetPerTimeInstant",
        ],
    ),
    (
        "Real",
        &[
            "declaredType",
            "quantity",
            "unit",
            "displayUnit",
            "relativeQuantity",
            "min",
            "max",
            "nominal",
            "unbounded",
            "start",
            "derivative",
            "reinit",
        ],
    ),
    ("Integer", &["declaredType", "quantity", "min", "max", "start"]),
    ("Boolean", &["declaredType", "start"]),
    ("String", &["declaredType", "start"]),
    ("Unknown", &["index", "dependencies", "dependenciesKind"]),
];

/// The elements and attributes of FMUs of ours in FMI 3.0, and of them all attributes that say nothing about arrays,
/// clocks, aliases and units of a variable of its own.
const FMI3: [(&str, &[&str]); 20] = [
    (
        "fmiModelDescription",
        &[
            "fmiVersion",
            "modelName",
            "instantiationToken",
            "description",
            "author",
            "version",
            "copyright",
            "license",
            "generationTool",
            "generationDateAndTime",
            "variableNamingConvention",
        ],
    ),
    (
        "CoSimulation",
        &[
            "modelIdentifier",
            "needsExecutionTool",
            "canBeInstantiatedOnlyOncePerProcess",
            "canGetAndSetFMUState",
            "canSerializeFMUState",
            "providesDirectionalDerivatives",
            "providesAdjointDerivatives",
            "canHandleVariableCommunicationStepSize",
            "maxOutputDerivativeOrder",
            "providesIntermediateUpdate",
            "mightReturnEarlyFromDoStep",
            "hasEventMode",
        ],
    ),
    ("UnitDefinitions", &[]),
    ("Unit", &["name"]),
    ("BaseUnit", &["kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor", "offset"]),
    ("DisplayUnit", &["name", "factor", "offset", "inverse"]),
    ("TypeDefinitions", &[]),
    ("Float64Type", &["name", "description", "quantity", "unit", "displayUnit", "relativeQuantity", "unbounded"]),
    ("LogCategories", &[]),
    ("Category", &["name", "description"]),
    ("DefaultExperiment", &["startTime", "stopTime", "tolerance", "stepSize"]),
    ("ModelVariables", &[]),
    (
        "Float64",
        &[
            "name",
            "valueReference",
            "description",
            "causality",
            "variability",
            "initial",
            "declaredType",
            "min",
            "max",
            "nominal",
            "start",
            "intermediateUpdate",
        ],
    ),
    ("Int32", &["name", "valueReference", "description", "causality", "variability", "initial", "min", "max", "start"]),
    ("Boolean", &["name", "valueReference", "description", "causality", "variability", "initial", "start"]),
    ("String", &["name", "valueReference", "description", "causality", "variability", "initial"]),
    ("Start", &["value"]),
    ("ModelStructure", &[]),
    ("Output", &["valueReference", "dependencies", "dependenciesKind"]),
    ("InitialUnknown", &["valueReference", "dependencies", "dependenciesKind"]),
];

/// A finding for each attribute that the schema does not know, in FMI 3.0 also for those and for the elements that FMUs of
/// ours do not have; those of other namespaces are others' business.
pub(super) fn findings(document: &Document, version: FmiVersion) -> Vec<String> {
    let (table, of): (&[(&str, &[&str])], _) = match version {
        FmiVersion::V2 => (&FMI2, "FMI 2.0"),
        FmiVersion::V3 => (&FMI3, "FMUs of ours in FMI 3.0"),
    };
    let mut findings = Vec::new();
    for node in document.descendants().filter(Node::is_element) {
        let element = node.tag_name().name();
        let Some((_, known)) = table.iter().find(|(name, _)| *name == element) else {
            let finding = || format!("<{element}> {}: no element in {of}", place(&node, version));
            findings.extend((version == FmiVersion::V3).then(finding));
            continue;
        };
        let attributes = node.attributes().filter(|attribute| attribute.namespace().is_none());
        let strange = attributes.filter(|attribute| !known.contains(&attribute.name()));
        findings.extend(strange.map(|attribute| {
            format!("<{element}> {}: no attribute {:?} in {of}", place(&node, version), attribute.name())
        }));
    }
    findings
}

/// The variable, unit or type that an element is part of, where it has a name.
fn place<'a>(node: &Node<'a, '_>, version: FmiVersion) -> &'a str {
    let own = node.attribute("name").filter(|_| version == FmiVersion::V3);
    own.or_else(|| node.parent_element().and_then(|parent| parent.attribute("name"))).unwrap_or_default()
}
