"""Scans of surfaces in cases: read once, relative to the case file, and replaced by their numbers."""

import pickle
from pathlib import Path

import pytest

import tribodyn as td
from tribodyn.cases.scans import FOLLOWING
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import built_in, parse_case
from tribodyn.surfaces import SelfAffine, Treatment, analyse, asperities, generate, write_text

SURFACE = "asperities.surface"
BUSHING = generate(SelfAffine(1e-6, 0.8, 24e-6, 8e-6), (96, 128), 1e-6, 1)
TRUNNION = generate(SelfAffine(0.4e-6, 0.6, 30e-6, 8e-6), (600,), 1e-6, 2)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder that is not the current one, with two scans and a case that names one."""
    write_text(BUSHING, tmp_path / "scan.csv")
    write_text(TRUNNION, tmp_path / "line.csv")
    head = 'case = "vsv"\n[asperities]\nsurface = "scan.csv"\n'
    (tmp_path / "mine.toml").write_text(f'{head}short_cutoff = "6 um"\n')
    return tmp_path


def test_a_scan_gives_asperities_and_roughness(folder: Path) -> None:
    case = td.load_case(folder / "mine.toml")
    expected = analyse(BUSHING, Treatment(short_cutoff=6e-6))
    assert case.asperities.density == pytest.approx(expected.asperities.density, rel=1e-12)
    assert case.asperities.radius == pytest.approx(expected.asperities.radius, rel=1e-12)
    assert case.surface_pair.roughness == pytest.approx((0.0, expected.sigma), rel=1e-12)
    assert "scan.csv" in case.asperities.origin
    assert "6 um" in case.asperities.origin


def test_the_resolved_case_needs_no_scan(folder: Path) -> None:
    case = td.load_case(folder / "mine.toml")
    (folder / "scan.csv").unlink()
    for comments in (False, True):
        text = case.to_toml(comments=comments)
        assert parse_case(text, "case.toml") == case
        assert parse_case(text, "case.toml").to_toml() == case.to_toml()


def test_other_keys_change_without_the_scan(folder: Path) -> None:
    case = td.load_case(folder / "mine.toml")
    (folder / "scan.csv").unlink()
    wide = pickle.loads(pickle.dumps(case)).replace({"joint.clearance": "30 um"})
    assert [wide.at(path) for path in FOLLOWING] == [case.at(path) for path in FOLLOWING]


def test_another_treatment_reads_the_scan_again(folder: Path) -> None:
    case = td.load_case(folder / "mine.toml").replace({"joint.clearance": "30 um"})
    smooth = pickle.loads(pickle.dumps(case)).replace({"asperities.short_cutoff": "12 um"})
    assert smooth.asperities.radius > 1.5 * case.asperities.radius
    assert smooth.joint.clearance == 30e-6
    assert "12 um" in smooth.asperities.origin
    level = smooth.replace({"asperities.level": "quadratic"})
    assert "quadratic level" in level.asperities.origin
    assert "12 um" in level.asperities.origin


def test_numbers_given_later_take_the_place_of_the_scan(folder: Path) -> None:
    case = td.load_case(folder / "mine.toml")
    blunt = case.replace({"asperities.radius": "9 um"})
    assert blunt.asperities.radius == 9e-6
    assert blunt.asperities.density == case.asperities.density
    assert blunt.surfaces.trunnion.roughness == 0.0
    assert blunt.asperities.origin == ""
    back = blunt.replace({SURFACE: str(folder / "scan.csv"), "asperities.short_cutoff": "6 um"})
    assert back == case


def test_scans_of_both_surfaces_add_their_moments(folder: Path) -> None:
    each = {"bushing": BUSHING, "trunnion": TRUNNION}
    files = {"bushing": "scan.csv", "trunnion": "line.csv"}
    case = td.load_case("vsv").replace(
        {f"surfaces.{name}.surface": str(folder / files[name]) for name in each}
    )
    found = {name: analyse(scan) for name, scan in each.items()}
    expected = asperities(found["bushing"].moments + found["trunnion"].moments)
    assert case.asperities.density == pytest.approx(expected.density, rel=1e-12)
    assert case.asperities.radius == pytest.approx(expected.radius, rel=1e-12)
    sigmas = (found["trunnion"].sigma, found["bushing"].sigma)
    assert case.surface_pair.roughness == pytest.approx(sigmas, rel=1e-12)
    assert case.asperities.origin.startswith("line.csv and scan.csv")
    one = case.replace({SURFACE: str(folder / "scan.csv")})
    assert one.surfaces.trunnion.roughness == 0.0


@pytest.mark.parametrize("name", built_in())
def test_every_kind_of_case_takes_a_scan(name: str, folder: Path) -> None:
    case = td.load_case(name).replace({SURFACE: str(folder / "scan.csv")})
    assert "scan.csv" in str(case.at("asperities.origin"))


@pytest.mark.parametrize(
    ("lines", "key", "said"),
    [
        ('surface = "scan.csv"\ndensity = "1 1/um^2"', "asperities.density", "not both"),
        ('surface = "scan.csv"\nradius = "1 um"', "asperities.radius", "not both"),
        ('surface = "scan.csv"\norigin = "mine"', "asperities.origin", "not both"),
        (
            'surface = "scan.csv"\n[surfaces.bushing]\nroughness = "1 um"',
            "surfaces.bushing.roughness",
            "not both",
        ),
        (
            'surface = "scan.csv"\n[surfaces.bushing]\nsurface = "scan.csv"',
            "surfaces.bushing.surface",
            "not both",
        ),
        ('[surfaces.bushing]\nsurface = "scan.csv"', "surfaces.bushing.surface", "surfaces.trunnion.surface"),
        ('surface = "none.csv"', SURFACE, "no such file"),
        ('surface = "."', SURFACE, "directory"),
        ('surface = ""', SURFACE, "the name of a file"),
        ("surface = 3", SURFACE, "the name of a file"),
        ('surface = "a\\u0000b"', SURFACE, "the name of a file"),
        ('surface = "mine.toml"', SURFACE, "mine.toml"),
        ('surface = "bare.csv"', SURFACE, "a case needs a file that says it itself"),
        ('level = "plane"', "asperities.level", "belongs to a scan"),
        ('surface = "scan.csv"\nlevel = "plain"', "asperities.level", "mean, plane, quadratic"),
        ('surface = "scan.csv"\nshort_cutoff = "1 m"', "asperities.short_cutoff", "the scan holds waves"),
        ('surface = "scan.csv"\nlong_cutoff = "-1 um"', "asperities.long_cutoff", "scan holds waves"),
        ('surface = "scan.csv"\nshort_cutoff = 5', "asperities.short_cutoff", "the unit is missing"),
    ],
)
def test_what_cannot_be_is_refused(lines, key, said, folder, monkeypatch):
    monkeypatch.chdir(folder)  # long paths are shortened in messages
    pytest.importorskip("SurfaceTopography")
    (folder / "bare.csv").write_text("1,2\n3,4\n")
    (folder / "mine.toml").write_text(f'case = "vsv"\n[asperities]\n{lines}\n')
    with pytest.raises(InputError) as caught:
        td.load_case("mine.toml")
    assert caught.value.key == key
    assert said in str(caught.value)
    assert str(caught.value).startswith("mine.toml: ")
