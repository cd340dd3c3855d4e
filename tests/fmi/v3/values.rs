//! Values as FMI 3.0 alone has them: the time, Booleans of one byte, what can be read before initialisation.

use crate::support::*;

#[test]
fn the_time_is_a_variable_that_is_read_and_never_set() {
    let fmu = Fmu::v3(SCENE);
    assert_eq!(fmu.vr("time"), u32::try_from(fmu.table.iter().count()).unwrap());
    let instance = fmu.instance();
    assert_eq!(instance.real("time"), 0.0);
    assert_eq!(instance.enter_from(-1.5, None), OK);
    assert_eq!(instance.real("time"), -1.5);
    instance.calls(&[fmi3ExitInitializationMode]);
    assert_eq!(instance.stepped(-1.5, 0.25).0, OK);
    instance.log();
    assert_eq!(instance.real("time"), -1.25);
    assert_eq!(instance.set_real("time", 0.0), ERROR);
    assert!(instance.only_error().contains("time: computed by the FMU"));
    assert_eq!(instance.real("time"), -1.25);
}

#[test]
fn booleans_are_of_one_byte() {
    let fmu = Fmu::v3(SCENE);
    let instance = fmu.instance();
    instance.initialize();
    let vr = [fmu.vr("contact[1].active"), fmu.vr("contact[2].active")];
    let mut values = [77_u8; 4];
    // SAFETY: two references, and room for two values and more.
    let status = unsafe { fmi3GetBoolean(instance.component, vr.as_ptr(), 2, values.as_mut_ptr(), 2) };
    assert_eq!((status, values), (OK, [0, 0, 77, 77]));
}

#[test]
fn start_values_can_be_read_and_set_before_initialisation() {
    let fmu = Fmu::v3(RICH);
    let looked_at = fmu.instance();
    let before = looked_at.outputs();
    let frequency = looked_at.real("left.frequency[1]");
    for instance in [&looked_at, &fmu.instance()] {
        assert_eq!(instance.set_real("left.mass[1]", 4.0), OK);
        assert_eq!(instance.set_real("ground.scale", 1.5), OK);
    }
    assert!(looked_at.real("left.frequency[1]") < frequency);
    assert_ne!(looked_at.outputs(), before);
    let run = |instance: &Instance<'_>| {
        instance.initialize();
        instance.run(0.0, 0.02, 50)
    };
    let other = fmu.instance();
    assert_eq!(other.set_real("left.mass[1]", 4.0), OK);
    assert_eq!(other.set_real("ground.scale", 1.5), OK);
    assert_eq!(run(&looked_at), run(&other), "looking changes nothing");
}

#[test]
fn inputs_before_initialisation_move_with_the_start_time() {
    let fmu = Fmu::v3(SCENE);
    let run = |early: bool, looks: bool| {
        let instance = fmu.instance();
        if early {
            assert_eq!(instance.set_real("ground.acceleration", 2.0), OK);
        }
        if looks {
            instance.outputs();
        }
        assert_eq!(instance.enter_from(5.0, None), OK);
        if !early {
            assert_eq!(instance.set_real("ground.acceleration", 2.0), OK);
        }
        instance.calls(&[fmi3ExitInitializationMode]);
        assert_eq!(instance.stepped(5.0, 0.5).0, OK);
        instance.outputs()
    };
    assert_eq!(run(true, false), run(false, false));
    assert_eq!(run(true, true), run(false, false));
}

#[test]
fn without_flags_the_bits_are_those_of_fmi_2() {
    let both = Fmu::both(RECORD_SCENE);
    let [of_2, of_3] = both.each_ref().map(Fmu::instance);
    of_2.start();
    of_3.start();
    assert!(of_2.run(0.0, 0.02, 100) == of_3.run(0.0, 0.02, 100));
    assert!(of_2.integer("impacts") > 0);
}
