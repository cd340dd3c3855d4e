"""What the file of a shared library says about itself, whatever its format.

LIEF reads ELF, PE and Mach-O on every system; objdump knows the formats that it was configured for and prints text.
"""

from dataclasses import dataclass

import lief

from releasing.commands import Failure

ELF, PE, MACH_O = "ELF", "PE", "Mach-O"
MACHINES = {
    lief.ELF.ARCH.X86_64: "x86-64",
    lief.ELF.ARCH.AARCH64: "aarch64",
    lief.PE.Header.MACHINE_TYPES.AMD64: "x86-64",
    lief.PE.Header.MACHINE_TYPES.ARM64: "aarch64",
    lief.MachO.Header.CPU_TYPE.X86_64: "x86-64",
    lief.MachO.Header.CPU_TYPE.ARM64: "aarch64",
}
# Bits in the type of a symbol in a Mach-O file that only those of a debugger have.
N_STAB = 0xE0


@dataclass(frozen=True)
class Library:
    format: str
    machine: str
    exports: frozenset  # names of functions and data
    libraries: frozenset  # names of those that it needs
    versions: frozenset  # of symbols in those, such as GLIBC_2.14
    is_stripped: bool
    minimum_system: str | None = None  # of macOS

    def newest_glibc(self):
        """As a pair of numbers; None where the file names no version of glibc."""
        numbers = [version.removeprefix("GLIBC_") for version in self.versions if version.startswith("GLIBC_")]
        return max((tuple(map(int, number.split("."))) for number in numbers if number[0].isdigit()), default=None)


def read(path):
    return read_bytes(path.read_bytes(), path)


def read_bytes(content, name="a member"):
    lief.logging.disable()
    binary = lief.parse(content)
    kinds = {lief.ELF.Binary: of_elf, lief.PE.Binary: of_pe, lief.MachO.Binary: of_mach_o}
    if type(binary) not in kinds:
        raise Failure(f"{name}: not a shared library")
    return kinds[type(binary)](binary)


def of_elf(binary):
    versions = [
        auxiliary.name
        for library in binary.symbols_version_requirement
        for auxiliary in library.get_auxiliary_symbols()
    ]
    is_stripped = not any(section.name == ".symtab" or section.name.startswith(".debug") for section in binary.sections)
    return Library(
        ELF,
        machine(binary.header.machine_type),
        frozenset(symbol.name for symbol in binary.exported_symbols),
        frozenset(binary.libraries),
        frozenset(versions),
        is_stripped,
    )


def of_pe(binary):
    exports = binary.get_export()
    names = [entry.name for entry in exports.entries] if exports else []
    imports = [library.name.lower() for library in (*binary.imports, *binary.delay_imports)]
    is_stripped = binary.header.numberof_symbols == 0 and not any(
        section.name.startswith((".debug", "/")) for section in binary.sections
    )
    return Library(PE, machine(binary.header.machine), frozenset(names), frozenset(imports), frozenset(), is_stripped)


def of_mach_o(binary):
    # C symbols begin with an underscore there.
    names = [symbol.name.removeprefix("_") for symbol in binary.exported_symbols]
    own = binary.header.file_type == lief.MachO.Header.FILE_TYPE.DYLIB
    needed = [
        library.name
        for library in binary.libraries
        if not (own and library.command == lief.MachO.LoadCommand.TYPE.ID_DYLIB)
    ]
    build = binary.build_version or binary.version_min
    minimum = ".".join(map(str, (build.minos if binary.build_version else build.version)[:2])) if build else None
    is_stripped = not any(symbol.raw_type & N_STAB for symbol in binary.symbols)
    return Library(
        MACH_O, machine(binary.header.cpu_type), frozenset(names), frozenset(needed), frozenset(), is_stripped, minimum
    )


def machine(number):
    return MACHINES.get(number, str(number))
