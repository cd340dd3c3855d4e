"""The sources of Rust's standard library from Debian's package rust-src, without installing it.

The version of rustc may be in any release of Debian, so apt looks through all of them, with a configuration of its own
that names the servers which the machine's own configuration names.
"""

from pathlib import Path

from releasing.commands import Failure, run
from releasing.places import WORK

FOLDER = WORK / "debian"
RELEASES = ("stable-backports", "stable", "testing", "unstable", "oldstable-backports", "oldstable")
KEYS = Path("/usr/share/keyrings/debian-archive-keyring.gpg")


def library():
    """The folder `library` of the sources that fit the compiler."""
    version = run("rustc", "-V").split()[1]
    found = FOLDER / f"usr/src/rustc-{version}/library"
    if not found.is_dir():
        fetch(version)
    if not found.is_dir():
        raise Failure(f"Debian's rust-src for {version} holds no usr/src/rustc-{version}/library")
    return found


def fetch(version):
    apt = configure()
    # A release that a server does not have is no reason to stop.
    run("sh", "-c", "apt-get --quiet update || true", variables=apt)
    offered = [
        line.split("|")[1].strip() for line in run("apt-cache", "madison", "rust-src", variables=apt).splitlines()
    ]
    run("apt-get", "--quiet", "download", f"rust-src={fitting(version, offered)}", variables=apt, folder=FOLDER)
    for package in FOLDER.glob("rust-src_*.deb"):
        run("dpkg-deb", "--extract", package, FOLDER)
        package.unlink()


def fitting(version, offered):
    """The first package of this version."""
    for package in offered:
        if package.startswith((f"{version}+", f"{version}-")):
            return package
    others = ", ".join(sorted(set(offered))) or "none"
    raise Failure(f"no release of Debian has rust-src {version}, the version of rustc; found: {others}")


def configure():
    """Writes the configuration and returns the variable that makes apt use it."""
    servers = run("apt-get", "indextargets", "--format", "$(REPO_URI)", "Created-By: Packages").split()
    if not servers:
        raise Failure("apt knows no server of packages; rust-src cannot be fetched from Debian")
    signed = f"[signed-by={KEYS}] " if KEYS.exists() else ""
    for folder in ("lists/partial", "cache/archives/partial"):
        (FOLDER / folder).mkdir(parents=True, exist_ok=True)
    sources = [f"deb {signed}{server} {release} main" for server in sorted(set(servers)) for release in RELEASES]
    (FOLDER / "sources.list").write_text("\n".join(sources) + "\n")
    # No translations; and root's home directory, where a checkout may be, is for root alone.
    (FOLDER / "apt.conf").write_text(
        f'Dir::Etc::sourcelist "{FOLDER}/sources.list";\n'
        'Dir::Etc::sourceparts "-";\n'
        f'Dir::State::lists "{FOLDER}/lists";\n'
        f'Dir::Cache "{FOLDER}/cache";\n'
        'Acquire::Languages "none";\n'
        'APT::Sandbox::User "root";\n'
    )
    return {"APT_CONFIG": FOLDER / "apt.conf"}
