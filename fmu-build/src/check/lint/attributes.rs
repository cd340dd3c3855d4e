//! Which attributes the elements of a description may have. FMI 2.0 has more elements than those of our FMUs, which are
//! not looked at here.

use roxmltree::{Document, Node};

const ATTRIBUTES: [(&str, &[&str]); 13] = [
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

/// A finding for each attribute that the schema does not know; those of other namespaces are others' business.
pub(super) fn findings(document: &Document) -> Vec<String> {
    let elements = document.descendants().filter(Node::is_element);
    let known = |name| ATTRIBUTES.iter().find(|(element, _)| *element == name).map(|(_, known)| *known);
    let strange = elements.filter_map(|node| Some((node, known(node.tag_name().name())?)));
    strange
        .flat_map(|(node, known)| {
            let attributes = node.attributes().filter(|attribute| attribute.namespace().is_none());
            let strange = attributes.filter(|attribute| !known.contains(&attribute.name()));
            let place = node.parent_element().and_then(|parent| parent.attribute("name")).unwrap_or_default();
            let element = node.tag_name().name();
            strange.map(move |attribute| format!("<{element}> {place}: no attribute {:?} in FMI 2.0", attribute.name()))
        })
        .collect()
}
