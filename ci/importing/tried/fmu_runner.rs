//! fmu-runner runs an FMU: prints the last values of some variables. Arguments: FMU, step, stop, a list of names, and a list of
//! NAME=VALUE that are set before the run; both with semicolons between.

use fmu_runner::{Fmu, FmuInstance, fmi2Type};
use std::collections::HashMap;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [fmu, step, stop, names, values] = arguments.as_slice() else { panic!("five arguments") };
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let (step, stop) = (number(step), number(stop));
    let library = Fmu::unpack(fmu).expect("an FMU").load(fmi2Type::fmi2CoSimulation).expect("its library");
    let fmu = FmuInstance::instantiate(&library, true).expect("an instance");
    let known = library.variables();
    let set = values.split(';').filter_map(|pair| pair.split_once('='));
    let set: HashMap<_, _> = set.map(|(name, value)| (&known[name], number(value))).collect();
    fmu.setup_experiment(0.0, None, None).expect("an experiment");
    fmu.set_reals(&set).expect("parameters");
    fmu.enter_initialization_mode().expect("initialisation");
    fmu.exit_initialization_mode().expect("the end of initialisation");
    for k in 0..(stop / step).round() as u32 {
        let now = f64::from(k) * step;
        fmu.do_step(now, f64::from(k + 1) * step - now, true).expect("a step");
    }
    for name in names.split(';') {
        println!("{:?}", fmu.get_reals(&[&known[name]]).expect("a number")[&known[name]]);
    }
}
