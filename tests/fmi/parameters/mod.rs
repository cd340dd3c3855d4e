//! Every parameter of a scene through the C interface: set there, it is as if the scene had said so.

mod dependencies;
mod effect;
mod limits;
mod links;
mod refusals;
mod rules;
mod scene;
mod soil;
