//! The flags of an instance in its life, and beside an instance with others.

use crate::support::*;

#[test]
fn the_flags_outlive_a_reset() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.with_flags(true, true);
    for _ in 0..2 {
        instance.start();
        let (status, stepped) = instance.stepped(0.0, 1.0);
        assert_eq!((status, stepped.event, stepped.early), (OK, 1, 1));
        instance.calls(&[fmi3Reset]);
    }
    assert_eq!(instance.enter_from(0.0, None), OK);
    instance.calls(&[fmi3ExitInitializationMode, fmi3Terminate, fmi3Reset]);
}

#[test]
fn instances_do_not_know_each_other() {
    let fmu = Fmu::v3(SCENE);
    let alone = fmu.instance();
    alone.initialize();
    let expected = alone.run(0.0, 0.05, 20);
    let (first, second) = (fmu.instance(), fmu.with_flags(true, true));
    first.initialize();
    second.start();
    assert_eq!(second.set_real("ground.acceleration", 3.0), OK);
    assert_eq!(second.stepped(0.0, 1.0).0, OK);
    assert_eq!(first.run(0.0, 0.05, 20), expected);
}
