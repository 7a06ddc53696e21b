"""Makes armadillo.msh beside this script: an upright creature with legs, arms, tail, ears, snout and banded shell.

    /usr/bin/python3 parameters/armadillo/mesh.py

The surface is built from rings of vertices: eight a ring up the body, six along each limb, which grows out of two faces
of the body. Gmsh fills it with tetrahedra. The creature looks along -y. It is 22.6 units high: Scale in the scenes
makes them metres.
"""

import math
import pathlib

import gmsh
import numpy

# The body from crotch to crown: height, half width, how far it reaches forward and back, y of its middle. The back
# goes in and out by bands.
BODY = [(6.2, 2.9, 2.3, 1.9, 0.2), (7.8, 3.7, 2.9, 4.1, 0.3), (9.2, 4.0, 3.3, 3.7, 0.4), (10.5, 4.1, 3.4, 4.7, 0.5),
        (11.8, 3.8, 3.3, 4.0, 0.4), (13.2, 3.5, 2.9, 4.4, 0.2), (14.6, 2.7, 2.2, 2.9, -0.1),
        (15.8, 1.7, 1.5, 1.5, -0.6), (17.2, 2.1, 1.8, 1.9, -1.1), (18.6, 1.9, 1.7, 1.7, -1.1),
        (19.4, 1.1, 1.0, 0.9, -1.0)]
CROWN = (0, -1.0, 19.8)
CROTCH = (0, 0.2, 5.9)

# Rings of a limb: centre, axis, radius, and how much the ring is stretched along x, y and z; then the tip.
# Limbs aside are those of the side x > 0.
ROUND = (1, 1, 1)
LEG = ([((1.9, 0, 4.9), (0.2, 0, -1), 1.5, ROUND), ((2.3, -0.3, 3.4), (0.2, 0, -1), 1.05, ROUND),
        ((2.6, 0, 1.9), (0, 0, -1), 0.85, ROUND), ((2.7, -0.2, 0.9), (0, 0, -1), 1.2, (1, 1.3, 1)),
        ((2.8, -0.6, 0), (0, 0, -1), 1.3, (1, 1.6, 1))], (2.8, -0.6, 0))
ARM = ([((4.5, -0.1, 12.4), (1, 0, -0.1), 1.15, ROUND), ((6.3, -0.7, 12.4), (0.9, -0.4, 0.2), 0.95, ROUND),
        ((7.3, -1.8, 13.6), (0.4, -0.5, 0.8), 0.85, ROUND), ((7.7, -2.7, 15.1), (0.1, -0.4, 1), 1.0, ROUND)],
       (7.9, -3.2, 16.4))
EAR = ([((2.2, -0.9, 20.1), (0.6, 0.1, 1), 0.95, (1, 0.7, 1)), ((2.9, -0.8, 21.4), (0.4, 0.1, 1), 0.95, (1, 0.7, 1))],
       (3.3, -0.7, 22.6))
TAIL = ([((0, 3.6, 6.2), (0, 1, -0.5), 1.3, ROUND), ((0, 5.0, 5.1), (0, 1, -0.8), 1.1, ROUND),
         ((0, 6.3, 4.0), (0, 1, -0.7), 0.9, ROUND), ((0, 7.6, 3.2), (0, 1, -0.4), 0.7, ROUND),
         ((0, 9.0, 2.9), (0, 1, -0.1), 0.5, ROUND)], (0, 10.4, 2.9))
SNOUT = ([((0, -3.8, 17.2), (0, -1, -0.25), 1.0, ROUND), ((0, -5.3, 16.7), (0, -1, -0.25), 0.7, ROUND)],
         (0, -6.6, 16.3))


class Surface:
    """Points, and faces of three or four of them, seen from outside in positive sense."""

    def __init__(self):
        self.points = []
        self.faces = []

    def add(self, point):
        self.points.append(numpy.array(point, dtype=float))
        return len(self.points) - 1

    def join(self, first, second):
        """Faces between two rings of as many vertices."""
        n = len(first)
        faces = [(first[i], first[(i + 1) % n], second[(i + 1) % n], second[i]) for i in range(n)]
        self.faces += faces
        return faces

    def close(self, ring, point):
        tip = self.add(point)
        self.faces += [(ring[i], ring[(i + 1) % len(ring)], tip) for i in range(len(ring))]

    def cut(self, faces):
        """Takes neighbouring faces away and gives the ring around the hole."""
        for face in faces:
            self.faces.remove(face)
        edges = {pair for face in faces for pair in zip(face, face[1:] + face[:1])}
        after = {a: b for a, b in edges if (b, a) not in edges}
        ring = [min(after)]
        while after[ring[-1]] != ring[0]:
            ring.append(after[ring[-1]])
        return ring

    def regular_ring(self, before, centre, axis, radius, stretch):
        """A regular polygon about an axis, turned so that its corners are next to those of the ring before."""
        axis = numpy.array(axis) / numpy.linalg.norm(axis)
        old = numpy.array([self.points[i] for i in before])
        old -= old.mean(axis=0)
        first = old[0] - axis * (old[0] @ axis)
        first /= numpy.linalg.norm(first)
        second = numpy.cross(axis, first)
        corners = numpy.exp(2j * math.pi / len(before) * numpy.arange(len(before)))
        places = old @ first + 1j * (old @ second)
        turn = (places / abs(places) / corners).sum()
        corners *= radius * turn / abs(turn)
        return [self.add(centre + numpy.array(stretch) * (z.real * first + z.imag * second)) for z in corners]

    def grow(self, ring, limb, side=1):
        """Adds a limb to a ring, or its mirror image where side is -1."""
        mirror = numpy.array([side, 1, 1])
        rings, tip = limb
        for centre, axis, radius, stretch in rings:
            new = self.regular_ring(ring, mirror * centre, mirror * axis, radius, stretch)
            self.join(ring, new)
            ring = new
        self.close(ring, mirror * tip)

    def triangles(self):
        """All faces as triangles: those of four vertices are cut along the shorter diagonal."""
        result = []
        for face in self.faces:
            if len(face) == 3:
                result.append(face)
                continue
            a, b, c, d = (self.points[v] for v in face)
            cut = 0 if numpy.linalg.norm(a - c) < numpy.linalg.norm(b - d) + 1e-9 else 1
            a, b, c, d = face[cut:] + face[:cut]
            result += [(a, b, c), (a, c, d)]
        return numpy.array(result)


def creature():
    surface = Surface()
    angles = math.pi / 4 * numpy.arange(8)    # from the front by the side x > 0 to the back
    rings = [[surface.add((width * math.sin(angle), y - (front if math.cos(angle) > 0 else back) * math.cos(angle), z))
              for angle in angles] for z, width, front, back, y in BODY]
    layers = [surface.join(lower, upper) for lower, upper in zip(rings, rings[1:])]
    surface.close(rings[-1], CROWN)

    crotch = surface.add(CROTCH)
    bottom = rings[0]
    surface.grow([crotch, *bottom[4::-1]], LEG)
    surface.grow([crotch, bottom[0], *bottom[:3:-1]], LEG, -1)
    for layer, limb in ((4, ARM), (9, EAR)):
        surface.grow(surface.cut(layers[layer][1:3]), limb)
        surface.grow(surface.cut(layers[layer][5:7]), limb, -1)
    surface.grow(surface.cut(layers[0][3:5]), TAIL)
    surface.grow(surface.cut([layers[8][7], layers[8][0]]), SNOUT)
    return surface


def fill(points, triangles, file):
    """Tetrahedra inside the triangles, which stay as they are."""
    gmsh.initialize()
    for option, value in {"General.Verbosity": 2, "General.NumThreads": 1, "Mesh.MshFileVersion": 2.2,
                          "Mesh.Algorithm3D": 10, "Mesh.MeshSizeExtendFromBoundary": 0, "Mesh.MeshSizeMax": 1.5,
                          "Mesh.OptimizeThreshold": 0.6}.items():
        gmsh.option.setNumber(option, value)
    gmsh.model.addDiscreteEntity(2, 1)
    gmsh.model.mesh.addNodes(2, 1, list(range(1, len(points) + 1)), numpy.round(points, 6).ravel())
    gmsh.model.mesh.addElementsByType(1, 2, [], (triangles + 1).ravel())
    gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop([1])], 1)
    gmsh.model.geo.synchronize()
    gmsh.model.addPhysicalGroup(3, [1], 1)
    gmsh.model.mesh.generate(3)
    gmsh.model.mesh.optimize("")
    gmsh.write(file)
    tetrahedra = gmsh.model.mesh.getElementsByType(4)[0]
    print(f"{file}: {len(gmsh.model.mesh.getNodes()[0])} vertices, {len(tetrahedra)} tetrahedra")
    gmsh.finalize()


if __name__ == "__main__":
    body = creature()
    fill(body.points, body.triangles(), str(pathlib.Path(__file__).with_name("armadillo.msh")))
