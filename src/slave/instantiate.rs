//! From what a master passes to an instance, or everything that is wrong with it.

use super::instance::Slave;
use super::interface::Interface;
use super::log::Log;
use super::resource_location::paths;
use super::status::Refusal;
use crate::FmiVersion;
use crate::description::Package;
use crate::scene::SCENE_RESOURCE;

/// Loads the resources of the FMU and checks that they are those of the description, by its GUID (FMI 3.0: its token).
///
/// # Errors
/// A location that is none, resources that cannot be read or hold no scene, and a GUID that is not theirs.
pub fn instantiate(interface: Interface, guid: &str, resource_location: &[u8], log: Log) -> Result<Slave, Refusal> {
    let (guid_name, location_name) = match interface.version() {
        FmiVersion::V2 => ("fmuGUID", "fmuResourceLocation"),
        FmiVersion::V3 => ("instantiationToken", "resourcePath"),
    };
    let candidates = paths(resource_location);
    let shown = String::from_utf8_lossy(resource_location);
    if candidates.is_empty() {
        return Err(Refusal::from(format!("{location_name} {shown:?}: expected a directory of this machine")));
    }
    let Some(directory) = candidates.iter().find(|directory| directory.join(SCENE_RESOURCE).is_file()) else {
        let expected = format!("expected the resources directory of the FMU, with {SCENE_RESOURCE} in it");
        return Err(Refusal::from(format!("{location_name} {shown:?}: {expected}")));
    };
    let package = Package::from_resources(directory)?;
    let slave = Slave::new(package, interface, log);
    let expected = slave.guid();
    if guid != expected {
        return Err(Refusal::from(format!(
            "{guid_name} {guid:?}: expected {expected:?}, that of the scene in the resources"
        )));
    }
    Ok(slave)
}
