//! Libraries for any machine, made by hand: as much of each format as a library has to have, and no code in it.

#[path = "../../../src/functions.rs"]
mod functions;

pub use functions::functions;
use pounding::FmiVersion;

/// A library for the folder below `binaries/` that exports the functions of both versions of FMI.
pub fn library(folder: &str) -> Vec<u8> {
    exporting(folder, &FmiVersion::ALL.map(functions).concat())
}

/// One that exports these functions.
pub fn exporting(folder: &str, functions: &[&str]) -> Vec<u8> {
    match folder {
        "linux64" | "x86_64-linux" => elf(62, functions),
        "aarch64-linux" => elf(183, functions),
        "win64" | "x86_64-windows" => pe(0x8664, functions),
        "aarch64-windows" => pe(0xaa64, functions),
        "darwin64" | "x86_64-darwin" => macho(0x0100_0007, functions),
        "aarch64-darwin" => macho(0x0100_000c, functions),
        _ => panic!("{folder}"),
    }
}

/// Little-endian numbers of so many bytes each.
fn numbers(all: &[(usize, usize)]) -> Vec<u8> {
    all.iter().flat_map(|(number, bytes)| number.to_le_bytes()[..*bytes].to_vec()).collect()
}

/// Strings that end with a zero, behind an empty one, and where each begins.
fn strings(texts: impl Iterator<Item = String>) -> (Vec<u8>, Vec<usize>) {
    let (mut bytes, mut places) = (vec![0], Vec::new());
    for text in texts {
        places.push(bytes.len());
        bytes.extend_from_slice(text.as_bytes());
        bytes.push(0);
    }
    (bytes, places)
}

/// Header, dynamic symbols, their names, the names of sections, the table of sections.
fn elf(machine: usize, functions: &[&str]) -> Vec<u8> {
    let (names, places) = strings(functions.iter().map(|name| (*name).to_owned()));
    let symbols = [0; 24].into_iter().chain(places.iter().flat_map(|place| {
        // A global function in the first section.
        numbers(&[(*place, 4), (0x12, 1), (0, 1), (1, 2), (64, 8), (1, 8)])
    }));
    let symbols: Vec<u8> = symbols.collect();
    let (at_names, at_table) = (64 + symbols.len(), 64 + symbols.len() + names.len());
    let section = |kind, at, size, link, entry| {
        numbers(&[(0, 4), (kind, 4), (2, 8), (at, 8), (at, 8), (size, 8), (link, 4), (1, 4), (1, 8), (entry, 8)])
    };
    let mut file = b"\x7fELF\x02\x01\x01\0\0\0\0\0\0\0\0\0".to_vec();
    file.extend(numbers(&[(3, 2), (machine, 2), (1, 4), (0, 8), (0, 8), (at_table, 8), (0, 4)]));
    file.extend(numbers(&[(64, 2), (56, 2), (0, 2), (64, 2), (3, 2), (2, 2)]));
    file.extend(symbols.iter().chain(&names));
    file.extend([0; 64]);
    file.extend(section(11, 64, symbols.len(), 2, 24));
    file.extend(section(3, at_names, names.len(), 0, 0));
    file
}

/// Headers of 512 bytes, and a section with the table of exports and what it names.
fn pe(machine: usize, functions: &[&str]) -> Vec<u8> {
    const SECTION: usize = 0x1000;
    let count = functions.len();
    let (names, places) = strings(functions.iter().map(|name| (*name).to_owned()));
    let (at_addresses, at_pointers) = (SECTION + 40, SECTION + 40 + 4 * count);
    let (at_ordinals, at_names) = (at_pointers + 4 * count, at_pointers + 6 * count);
    // Behind the table: what is inside it is another library's.
    let code = at_names + names.len();
    let mut section = numbers(&[(0, 8), (0, 4), (at_names, 4), (1, 4), (count, 4), (count, 4), (at_addresses, 4)]);
    section.extend(numbers(&[(at_pointers, 4), (at_ordinals, 4)]));
    section.extend((0..count).flat_map(|_| numbers(&[(code, 4)])));
    section.extend(places.iter().flat_map(|place| numbers(&[(at_names + place, 4)])));
    section.extend((0..count).flat_map(|index| numbers(&[(index, 2)])));
    section.extend(names);
    let exports = section.len();
    section.extend([0xc3; 16]);

    let mut file = vec![0; 64];
    file[..2].copy_from_slice(b"MZ");
    file[60] = 64;
    file.extend(b"PE\0\0");
    file.extend(numbers(&[(machine, 2), (1, 2), (0, 4), (0, 4), (0, 4), (240, 2), (0x2022, 2)]));
    file.extend(numbers(&[(0x20b, 2)]));
    file.extend([0; 22]);
    file.extend(numbers(&[(0x1_8000_0000, 8), (0x1000, 4), (0x200, 4)]));
    file.extend(numbers(&[(6, 4), (0, 4), (6, 4), (0, 4), (0x3000, 4), (0x200, 4), (0, 4), (2, 2), (0, 2)]));
    file.extend([0; 32]);
    file.extend(numbers(&[(0, 4), (16, 4), (SECTION, 4), (exports, 4)]));
    file.extend([0; 15 * 8]);
    file.extend(b".text\0\0\0");
    file.extend(numbers(&[(section.len(), 4), (SECTION, 4), (section.len(), 4), (0x200, 4)]));
    file.extend(numbers(&[(0, 8), (0, 4), (0x6000_0020, 4)]));
    file.resize(0x200, 0);
    file.extend(section);
    file
}

/// Header, a segment with one section, symbols and their names.
fn macho(machine: usize, functions: &[&str]) -> Vec<u8> {
    let (names, places) = strings(functions.iter().map(|name| format!("_{name}")));
    let (at_symbols, count) = (208, places.len());
    let at_names = at_symbols + 16 * count;
    let size = at_names + names.len();
    let name = |text: &str| [text.as_bytes(), &[0; 16]].concat()[..16].to_vec();
    let mut file = numbers(&[(0xfeed_facf, 4), (machine, 4), (3, 4), (6, 4), (2, 4), (176, 4), (0, 8)]);
    file.extend(numbers(&[(0x19, 4), (152, 4)]));
    file.extend(name("__TEXT"));
    file.extend(numbers(&[(0, 8), (size, 8), (0, 8), (size, 8), (5, 4), (5, 4), (1, 4), (0, 4)]));
    file.extend([name("__text"), name("__TEXT")].concat());
    file.extend(numbers(&[(0, 8), (16, 8), (0, 4), (0, 4), (0, 8), (0x400, 4), (0, 8), (0, 4)]));
    file.extend(numbers(&[(2, 4), (24, 4), (at_symbols, 4), (count, 4), (at_names, 4), (names.len(), 4)]));
    // External, in the first section.
    file.extend(places.iter().flat_map(|place| numbers(&[(*place, 4), (0x0f, 1), (1, 1), (0, 2), (0, 8)])));
    file.extend(names);
    file
}

/// A file of macOS with libraries for several machines.
pub fn universal(folders: &[&str]) -> Vec<u8> {
    let mut file = [0xcafe_babe_u32, folders.len() as u32].map(u32::to_be_bytes).concat();
    let (mut table, mut parts) = (Vec::new(), Vec::new());
    for folder in folders {
        let part = library(folder);
        let machine = u32::from_le_bytes(part[4..8].try_into().unwrap());
        let at = 8 + 20 * folders.len() + parts.len();
        table.extend([machine, 3, at as u32, part.len() as u32, 0].map(u32::to_be_bytes).concat());
        parts.extend(part);
    }
    file.extend(table);
    file.extend(parts);
    file
}
