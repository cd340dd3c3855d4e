//! Records in the standard file of accelerations of UNAM, Mexico [Unam2004]: a header of lines `KEY : VALUE`, in which the
//! channels stand as `/A/B/C`, then a row of all channels a sample.

use super::accelerogram::Accelerogram;
use super::components::{self, Component};
use super::error::RecordError;
use super::format::Format;
use super::header::{Header, positive};
use super::numbers::fortran_number;
use super::options::Column;
use super::reading::{Reading, numbered};
use super::table::Told;
use super::unit::Unit;

const MOST_HEADER_LINES: usize = 300;
const MARK: &str = "ARCHIVO ESTANDAR DE ACELERACION";
const SAMPLES_BELOW: &str = "DATOS DE ACELERACION";
const DIRECTIONS: &str = "ORIENTACION";
const INTERVAL: &str = "INTERVALO DE MUESTREO";
const SAMPLES: &str = "NUM. TOTAL DE MUESTRAS";
const DURATION: &str = "DURACION DEL REGISTRO";
const PEAK: &str = "ACEL. MAX.(Gal)";
const UNIT: &str = "UNIDADES DE LOS DATOS";

/// Whether a text has such a header.
pub(super) fn is_it(text: &str) -> bool {
    text.lines().take(20).any(|line| line.starts_with(MARK))
}

pub(super) fn parse(text: &str, wanted: Option<&Column>) -> Result<Accelerogram, RecordError> {
    let lines = || numbered(text).take(MOST_HEADER_LINES);
    let head = Header::new("UNAM", lines().take_while(|(_, line)| !line.starts_with(SAMPLES_BELOW)));
    let mut reading = Reading::with_capacity(0);
    let unit = head.value(UNIT, "a unit of acceleration, Gal", Unit::read, &mut reading);
    let names = channels(&head, DIRECTIONS).into_iter().enumerate();
    let components: Vec<Component> = names.map(|(place, (_, name))| Component::new(place + 1, name)).collect();
    if components.is_empty() {
        reading.refuse(|| format!("UNAM: no {DIRECTIONS}: expected the channels behind it, such as /V/N90E/N00E"));
        return Err(reading.stop());
    }
    let chosen = components::choose(&components, wanted)?;
    let of_chosen = |key: &str| channels(&head, key).into_iter().nth(chosen);
    let missing = |key: &'static str| move || format!("UNAM: no {key}: expected one for each channel");
    let step = reading.value(of_chosen(INTERVAL), (INTERVAL, missing(INTERVAL)), "a number of seconds > 0", positive);
    let samples = |text: &str| text.parse::<usize>().ok();
    let count = reading.value(of_chosen(SAMPLES), (SAMPLES, missing(SAMPLES)), "a number of samples", samples);
    // Below the names a ruler ends the header.
    let below = lines().skip(head.lines.len()).filter(|(_, line)| line.starts_with("---"));
    let ruler = reading.value(below.last(), (SAMPLES_BELOW, missing(SAMPLES_BELOW)), "a ruler", |_| Some(()));
    let (Some((_, unit)), Some((_, step)), Some((line, count)), Some((ruler, ()))) = (unit, step, count, ruler) else {
        return Err(reading.stop());
    };
    let number = |(line, text): (usize, &str)| Some((line, fortran_number(text)?));
    let peaks = channels(&head, PEAK).into_iter().map_while(number).collect();
    let duration = of_chosen(DURATION).and_then(number);
    let about = head.about(&["CLAVE DE LA ESTACION", "NOMBRE DE LA ESTACION", "FECHA DEL SISMO [GMT]"]);
    let count = (line, SAMPLES, count);
    let first = ruler + 1;
    let told = Told {
        format: Format::Unam,
        about,
        unit,
        first,
        components,
        has_times: false,
        step,
        count,
        peaks,
        repeats_last: true,
        duration,
    };
    told.read(text, wanted, reading)
}

/// What the lines of a key, `C1-C6` and `C7-C12`, say of each channel: `KEY, C1-C6 (s) : /A/B/C`.
fn channels<'t>(head: &Header<'t>, key: &str) -> Vec<(usize, &'t str)> {
    let lines = head.lines.iter().filter(|(_, line)| line.starts_with(key));
    let said = lines.filter_map(|(number, line)| Some((*number, line.split_once(':')?.1)));
    said.flat_map(|(number, said)| said.split('/').skip(1).map(move |text| (number, text.trim()))).collect()
}
