"""polder_results_test.py RUN: the reader of python/ on the folder of a run of dike-seepage."""

import pathlib
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import polder_results

folder = pathlib.Path(sys.argv.pop(1))


class Reader(unittest.TestCase):
    def setUp(self):
        self.run = polder_results.Run(folder)

    def test_every_snapshot_is_whole_and_in_order(self):
        self.assertGreater(len(self.run), 4)
        self.assertTrue(np.all(np.diff(self.run.times) > 0))
        width, height, _ = self.run.section["size"]
        for snapshot in self.run:
            for points in (snapshot.soil, snapshot.water):
                self.assertEqual(len(np.unique(points.id)), len(points))
                self.assertTrue(np.all(points.volume > 0))
                self.assertTrue(np.all((points.position[:, 0] >= 0) & (points.position[:, 0] <= width)))
                self.assertTrue(np.all((points.position[:, 1] >= 0) & (points.position[:, 1] <= height)))
            self.assertEqual(snapshot.soil["effective_stress"].shape, (len(snapshot.soil), 6))

    def test_the_points_say_what_the_history_says(self):
        # Both are written at the same steps every half second; single precision is what differs.
        compared = 0
        for snapshot in self.run:
            row = np.argmin(np.abs(self.run.history["time"] - snapshot.time))
            if self.run.history["time"][row] != snapshot.time:
                continue
            soil, water = snapshot.soil, snapshot.water
            grains = np.asarray(soil.volume, float) * (1 - soil["porosity"])
            mean = np.average(np.linalg.norm(soil["displacement"], axis=1), weights=grains)
            self.assertAlmostEqual(mean, self.run.history["mean soil displacement"][row], delta=1e-6)
            self.assertAlmostEqual(np.sum(water.volume, dtype=float), self.run.history["water volume"][row], delta=2e-6)
            self.assertAlmostEqual(soil["porosity"].max(), self.run.history["largest porosity"][row], delta=1e-6)
            compared += 1
        self.assertGreater(compared, 3)

    def test_times_are_found_and_interpolated(self):
        middle = self.run.times[2]
        self.assertEqual(self.run.at(middle + 0.01).time, middle)
        times, values = self.run.history["time"], self.run.history["crest settlement"]
        between = 0.25 * times[3] + 0.75 * times[4]
        self.assertAlmostEqual(self.run.history.at("crest settlement", between), 0.25 * values[3] + 0.75 * values[4])
        self.assertTrue(np.isnan(self.run.history.at("crest settlement", times[-1] + 1)))
        self.assertEqual(self.run.history.units["crest settlement"], "m")

    def test_invariants_of_the_stress(self):
        points = polder_results.Points(np.zeros((1, 3)), {"effective_stress": np.array([[-1e3, -4e3, -1e3, 2e3, 0, 0]])})
        self.assertAlmostEqual(points.mean_effective_stress()[0], 2e3)
        self.assertAlmostEqual(points.deviatoric_stress()[0], 1e3 * np.sqrt(21))  # s = (1, -2, 1, 2) kPa

    def test_a_name_that_is_not_there_lists_those_that_are(self):
        with self.assertRaisesRegex(KeyError, "porousity.*porosity"):
            self.run.snapshot(0).soil["porousity"]
        with self.assertRaisesRegex(KeyError, "crest.*crest settlement"):
            self.run.history["crest"]
        with self.assertRaisesRegex(FileNotFoundError, "history.csv"):
            polder_results.Run(folder / "points")

    def test_half_a_row_is_left_out_and_half_a_snapshot_refused(self):
        with tempfile.TemporaryDirectory() as scratch:
            file = pathlib.Path(scratch) / "history.csv"
            file.write_text("time [s],crest [m]\n0,1\n0.5,0.9\n1,0.")
            self.assertEqual(list(polder_results.History(file)["crest"]), [1, 0.9])
            half = pathlib.Path(scratch) / "half.vtp"
            half.write_bytes((folder / "points/soil_00000.vtp").read_bytes()[:-40])
            with self.assertRaisesRegex(ValueError, "not a whole"):
                polder_results.read_vtp(half)

    def test_pandas_takes_the_history_where_it_is_installed(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("no pandas here (Debian: python3-pandas)")
        table = self.run.history.to_pandas()
        self.assertEqual(len(table), len(self.run.history))
        self.assertEqual(table["crest settlement"].iloc[-1], self.run.history["crest settlement"][-1])


if __name__ == "__main__":
    unittest.main()
