#!/usr/bin/python3
"""Open3D's and CloudCompare's answers to the scenes that `fit_peers --points FOLDER` wrote.

usage: fit_peers.py FOLDER POSES.jsonl     then: fit_peers KIND FIRST COUNT --poses POSES.jsonl

For measuring only: `apt-get install python3-open3d cloudcompare`. What is not installed is skipped
with a word. CPU seconds are the process' own; CloudCompare's include its start.
"""
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

import numpy as np

try:
    import open3d as o3d
except ImportError:
    o3d = None

VOXEL_M = {"valve": 0.010, "drill": 0.010}
LEAST_AREA_M2 = 0.02
MOST_TILT_COS = 0.70


def cloud_of(path, voxel_m):
    cloud = o3d.geometry.PointCloud()
    cloud.points = o3d.utility.Vector3dVector(np.loadtxt(path, ndmin=2))
    return cloud.voxel_down_sample(voxel_m)


def features_of(cloud, voxel_m):
    return o3d.pipelines.registration.compute_fpfh_feature(
        cloud, o3d.geometry.KDTreeSearchParamHybrid(radius=5 * voxel_m, max_nn=100))


def open3d_pose(folder, name, facts):
    """FPFH features, RANSAC on their matches, ICP: as Open3D's tutorial on global registration."""
    voxel_m = VOXEL_M[facts["kind"]]
    begin = time.process_time()
    model = cloud_of(folder / f"{name}_model.xyz", voxel_m)
    scene = cloud_of(folder / f"{name}.xyz", voxel_m)
    if len(scene.points) < 20:
        return [], time.process_time() - begin
    search = o3d.geometry.KDTreeSearchParamHybrid(radius=2.5 * voxel_m, max_nn=30)
    model.estimate_normals(search)
    model.orient_normals_towards_camera_location([0.0, 0.0, 2.0])
    scene.estimate_normals(search)
    scene.orient_normals_towards_camera_location(facts["viewpoint"])
    registration = o3d.pipelines.registration
    # From the scene to the model: half of the model has no counterpart.
    rough = registration.registration_ransac_based_on_feature_matching(
        scene, model, features_of(scene, voxel_m), features_of(model, voxel_m), True,
        1.5 * voxel_m, registration.TransformationEstimationPointToPoint(False), 3,
        [registration.CorrespondenceCheckerBasedOnEdgeLength(0.9),
         registration.CorrespondenceCheckerBasedOnDistance(1.5 * voxel_m)],
        registration.RANSACConvergenceCriteria(100000, 0.999))
    fine = registration.registration_icp(
        scene, model, 2.0 * voxel_m, rough.transformation,
        registration.TransformationEstimationPointToPlane())
    pose = np.linalg.inv(fine.transformation)
    return [{"pose": pose.flatten().tolist()}], time.process_time() - begin


def patch_of(points, up):
    """The rectangle of least area round points of a plane, tried degree by degree."""
    if len(points) < 20:
        return None
    mean = points.mean(axis=0)
    z = np.linalg.eigh(np.cov((points - mean).T))[1][:, 0]
    if z @ up < 0:
        z = -z
    if z @ up < MOST_TILT_COS:
        return None
    x = np.cross(z, np.eye(3)[np.argmin(np.abs(z))])
    x /= np.linalg.norm(x)
    y = np.cross(z, x)
    best = None
    for degree in range(90):
        u = np.cos(np.radians(degree)) * x + np.sin(np.radians(degree)) * y
        v = np.cross(z, u)
        flat = (points - mean) @ np.stack([u, v], 1)
        low, high = flat.min(axis=0), flat.max(axis=0)
        area = np.prod(high - low)
        if best is None or area < best[0]:
            best = (area, u, v, low, high)
    area, u, v, low, high = best
    if area < LEAST_AREA_M2:
        return None
    pose = np.eye(4)
    pose[:3, :3] = np.stack([u, v, z], 1)
    middle = 0.5 * (low + high)
    pose[:3, 3] = mean + middle[0] * u + middle[1] * v
    return {"pose": pose.flatten().tolist(), "length_m": high[0] - low[0],
            "width_m": high[1] - low[1]}


def cloud_compare_planes(folder, name, facts):
    """The RANSAC_SD plug-in's planes, each with the smallest rectangle round it."""
    with tempfile.TemporaryDirectory() as out:
        shutil.copy(folder / f"{name}.xyz", pathlib.Path(out) / "cloud.xyz")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(
            ["CloudCompare", "-SILENT", "-C_EXPORT_FMT", "ASC", "-O", "cloud.xyz", "-OCTREE_NORMALS",
             "0.05", "-ORIENT", "PLUS_Z", "-RANSAC", "EPSILON_ABSOLUTE", str(2.0 * facts["sigma_m"]),
             "BITMAP_EPSILON_ABSOLUTE", "0.06", "SUPPORT_POINTS", "40", "MAX_NORMAL_DEV", "25",
             "PROBABILITY", "0.01", "ENABLE_PRIMITIVE", "PLANE", "OUT_CLOUD_DIR", out,
             "OUTPUT_INDIVIDUAL_SUBCLOUDS"],
            cwd=out, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=120,
            env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        patches = []
        for path in sorted(pathlib.Path(out).glob("*PLANE*.asc")):
            patch = patch_of(np.loadtxt(path, ndmin=2)[:, :3], np.array(facts["up"]))
            if patch:
                patches.append(patch)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return patches, seconds


def main():
    folder, poses = pathlib.Path(sys.argv[1]), sys.argv[2]
    has_cloud_compare = shutil.which("CloudCompare") is not None
    if o3d is None:
        print("skipped: Open3D is not installed (apt-get install python3-open3d)")
    else:
        o3d.utility.random.seed(1) if hasattr(o3d.utility, "random") else None
    if not has_cloud_compare:
        print("skipped: CloudCompare is not installed (apt-get install cloudcompare)")
    with open(poses, "w", encoding="utf-8") as stream:
        for facts_path in sorted(folder.glob("*.json")):
            name, facts = facts_path.stem, json.loads(facts_path.read_text())
            if facts["kind"] == "terrain" and has_cloud_compare:
                method = "CloudCompare RANSAC_SD"
                answers, seconds = cloud_compare_planes(folder, name, facts)
            elif facts["kind"] != "terrain" and o3d is not None:
                method = f"Open3D FPFH-RANSAC + ICP, true {facts['kind']}"
                answers, seconds = open3d_pose(folder, name, facts)
            else:
                continue
            stream.write(json.dumps({"trial": name, "method": method, "seconds": seconds,
                                     "answers": answers}) + "\n")


if __name__ == "__main__":
    main()
