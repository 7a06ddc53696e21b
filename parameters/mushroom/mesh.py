"""Makes mushroom.msh beside this script: a slim stalk with a flared foot, and a wide cap, hollow underneath; in metres.

    /usr/bin/python3 parameters/mushroom/mesh.py

Gmsh turns a profile about the z axis. The stalk is cut into rings of six vertices; the cap has larger cells.
"""

import math
import pathlib

import gmsh

FOOT, NECK = -10.6, 3.5             # heights of the lower and upper end of the stalk
RIM, CROWN = (7.0, 1.4), 6.5        # radius and height of the cap's rim, height of its top
STALK, RINGS = 0.75, 11             # radius of the stalk, pieces along it
SMALL, LARGE = 1.4, 2.9             # edges of cells in the stalk and in the cap


def stalk_radius(z):
    return STALK * (0.95 + 0.55 * math.exp(-((z - FOOT) / 1.3)**2) + 0.15 * max(0, (z - 1.5) / 2)**2)


def build():
    """The body; gives its tag."""
    occ = gmsh.model.occ

    def point(radius, z):
        return occ.addPoint(radius, 0, z)

    heights = [FOOT + (NECK - FOOT) * i / RINGS for i in range(RINGS + 1)]
    stalk = [point(stalk_radius(z), z) for z in heights]
    middle, rim, crown = point(0, FOOT), point(*RIM), point(0, CROWN)
    profile = [occ.addLine(middle, stalk[0])]
    profile += [occ.addLine(lower, upper) for lower, upper in zip(stalk, stalk[1:])]
    profile.append(occ.addBezier([stalk[-1], point(0.55 * RIM[0], 3.4), rim]))
    profile.append(occ.addBezier([rim, point(0.97 * RIM[0], 4.8), point(0.5 * RIM[0], CROWN), crown]))
    profile.append(occ.addLine(crown, middle))
    half = occ.addPlaneSurface([occ.addCurveLoop(profile)])
    occ.revolve([(2, half)], 0, 0, 0, 0, 0, 1, 2 * math.pi)
    occ.remove([(2, half)], recursive=True)
    occ.synchronize()
    return gmsh.model.getEntities(3)[0][1]


def set_sizes():
    """Six vertices on each ring of the stalk, large cells in the cap away from the stalk."""
    for _, curve in gmsh.model.getEntities(1):
        box = gmsh.model.getBoundingBox(1, curve)
        if gmsh.model.getType(1, curve) == "Circle" and box[3] - box[0] < RIM[0]:
            gmsh.model.mesh.setTransfiniteCurve(curve, 7)
    aside = f"Max(0, Sqrt(x*x + y*y) - {STALK}) * Max(0, z - 1.2) / {RIM[0] / 2}"
    above = "Max(0, z - 3.6) / 2"
    field = gmsh.model.mesh.field.add("MathEval")
    gmsh.model.mesh.field.setString(field, "F", f"{SMALL} + {LARGE - SMALL} * Min(1, {aside} + {above})")
    gmsh.model.mesh.field.setAsBackgroundMesh(field)


def main(file):
    gmsh.initialize()
    for option, value in {"General.Verbosity": 2, "General.NumThreads": 1, "Mesh.MshFileVersion": 2.2,
                          "Mesh.Algorithm": 6, "Mesh.MeshSizeExtendFromBoundary": 0, "Mesh.MeshSizeFromPoints": 0,
                          "Mesh.OptimizeThreshold": 0.5}.items():
        gmsh.option.setNumber(option, value)
    gmsh.model.addPhysicalGroup(3, [build()], 1)
    set_sizes()
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.optimize("")
    gmsh.write(file)
    tetrahedra, corners = gmsh.model.mesh.getElementsByType(4)
    print(f"{file}: {len(set(corners))} vertices, {len(tetrahedra)} tetrahedra")
    gmsh.finalize()


if __name__ == "__main__":
    main(str(pathlib.Path(__file__).with_name("mushroom.msh")))
