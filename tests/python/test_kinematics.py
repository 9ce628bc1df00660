"""Kinematics and contact geometry against golden numbers."""
import numpy as np
import palpate
import pytest
from conftest import rows_of


def number(row, *names):
    return [float(row[name]) for name in names]


PHI = [f"phi{i}" for i in range(7)]


def test_golden_poses(golden):
    rows = rows_of(golden / "forward_kinematics.csv")
    sets = {row["set"]: number(row, *PHI) for row in rows}
    for name, angles in sets.items():
        found = palpate.kinematics(angles)
        taxels = [row for row in rows if row["set"] == name and row["kind"] == "taxel"]
        places = {(m, x, y): i for i, (m, x, y) in
                  enumerate(zip(found["matrix"], found["x"], found["y"]))}
        index = [places[tuple(int(float(row[k])) for k in ("matrix", "px", "py"))] for row in taxels]
        np.testing.assert_allclose(found["position_mm"][index],
                                   [number(row, "x_mm", "y_mm", "z_mm") for row in taxels], atol=1e-6)
        points = [row for row in rows if row["set"] == name and row["kind"] == "point_mm"]
        if points:
            at = palpate.surface_points(angles, [number(row, "matrix", "px", "py") for row in points])
            np.testing.assert_allclose(at["position_mm"],
                                       [number(row, "x_mm", "y_mm", "z_mm") for row in points], atol=1e-6)
    several = palpate.kinematics(list(sets.values()))
    assert several["position_mm"].shape == (len(sets), 486, 3)
    np.testing.assert_array_equal(several["position_mm"][-1], found["position_mm"])
    np.testing.assert_allclose(np.linalg.norm(several["normal"], axis=2), 1)
    assert several["exists"].sum() == 456


def test_golden_spheres(golden, recordings):
    for row in rows_of(golden / "bounding_sphere.csv")[::15]:
        path = recordings / row["file"]
        frame = int(row["frame"])
        found = palpate.contact(palpate.load(path), start=frame, stop=frame + 1)
        assert found["active"][0] == int(row["active"])
        np.testing.assert_allclose(found["sphere_mm"][0], number(row, "cx", "cy", "cz"), atol=1e-5)
        assert found["sphere_radius_mm"][0] == pytest.approx(float(row["radius"]), abs=1e-5)
        assert found["centroid_sphere_radius_mm"][0] == pytest.approx(
            float(row["centroid_radius"]), abs=1e-5)


def test_sphere_around_points():
    centre, radius = palpate.bounding_sphere([[1, 0, 0], [-1, 0, 0], [0, 0.5, 0]])
    np.testing.assert_allclose(centre, 0, atol=1e-9)
    assert radius == pytest.approx(1)
    assert palpate.bounding_sphere(np.zeros((0, 3))) is None


def test_contact_of_assumed_angles():
    frames = np.zeros((2, 486))
    frames[1, 84 + 6 * 6 + 2] = 500  # matrix 1, y 6, x 2
    profile = palpate.from_arrays([0, 30], frames)
    with pytest.raises(ValueError, match="angles"):
        palpate.contact(profile)
    found = palpate.contact(profile, angles_deg=[0] * 7)
    where = palpate.kinematics([0] * 7)["position_mm"][84 + 6 * 6 + 2]
    assert np.isnan(found["sphere_mm"][0]).all() and found["active"].tolist() == [0, 1]
    np.testing.assert_allclose(found["sphere_mm"][1], where)
    np.testing.assert_allclose(found["centroid_mm"][1, 1], where)
    assert np.isnan(found["centroid_mm"][1, 0]).all()
    assert palpate.contact(profile, angles_deg=[0] * 7, threshold=600)["active"].sum() == 0


def test_preshapes():
    assert "pinch-parallel" in palpate.preshapes()
    np.testing.assert_allclose(palpate.preshape("parallel", 0.5), [0, -34, 34, -34, 34, -34, 34])
    with pytest.raises(ValueError):
        palpate.preshape("parallel", 2)
    with pytest.raises(ValueError):
        palpate.preshape("fist")


def test_size_of_a_ball():
    profile, truth = palpate.synthesize(grasps=1)
    begin, end = truth[0]
    size = palpate.object_size(profile, begin, end)
    assert size["valid"], size["trouble"]
    assert set(size["pads"]) == {1, 5}
    assert size["diameter_mm"] == pytest.approx(np.median(size["distance_mm"]), abs=8)
