"""Lowest frequencies of a clamped block by Ritz's method: a reference that shares nothing with Supple.

    /usr/bin/python3 scripts/beam_frequency.py [DEGREE...]

The displacement is a product of piecewise polynomials along x, y and z; the pieces get shorter towards the clamp and
towards the edges, where the stress of the clamped end is singular unless Poisson's ratio is 0. All integrals are exact.
What is found is an upper bound, and falls with the degree towards the true frequency. By symmetry a quarter of the
section is enough: components are odd or even in y and z. Degree 4 takes a minute, degree 5 ten.
"""

import sys

import numpy
from numpy.polynomial import legendre

LENGTH, HEIGHT, YOUNG, DENSITY = 1.0, 0.1, 1e6, 1000.0
BENDING = [(0, 1), (1, 1), (0, 0)]  # along z; ux, uy, uz: odd (1) or even (0) in y and z
AXIAL = [(0, 0), (1, 0), (0, 1)]
ALONG = [0, 0.02, 0.1, 0.4, LENGTH]
ACROSS = [0, 0.4 * HEIGHT, 0.5 * HEIGHT]


def line(breaks, degree):
    """Integrals of products of shape functions, of which the first (0, 1) and the second may be differentiated."""
    n = degree * (len(breaks) - 1) + 1
    nodes = -numpy.cos(numpy.pi * numpy.arange(degree + 1) / degree)
    points, weights = legendre.leggauss(degree + 1)
    change = numpy.linalg.inv(legendre.legvander(nodes, degree))
    slopes = [legendre.legval(points, legendre.legder(row)) for row in numpy.eye(degree + 1)[1:]]
    shapes = [legendre.legvander(points, degree) @ change, numpy.stack([0 * points, *slopes], 1) @ change]
    result = numpy.zeros((2, 2, n, n))
    for e, (left, right) in enumerate(zip(breaks, breaks[1:])):
        half = (right - left) / 2
        part = slice(degree * e, degree * (e + 1) + 1)
        for a in (0, 1):
            for b in (0, 1):
                result[a, b, part, part] += shapes[a].T @ (weights[:, None] * half**(1 - a - b) * shapes[b])
    return result


def matrices(nu, parity, degree):
    """Stiffness, and the three blocks of the mass matrix."""
    lame, mu = YOUNG * nu / (1 + nu) / (1 - 2 * nu), YOUNG / 2 / (1 + nu)
    along, across = line(ALONG, degree), line(ACROSS, degree)

    def product(i, j, d, e):
        """Integral of component i derived along d times component j derived along e (None: not derived)."""
        result = along[int(d == 0), int(e == 0), 1:, 1:]  # the first vertex is clamped
        for axis in (1, 2):
            odd = parity[i][axis - 1], parity[j][axis - 1]  # these are 0 in the middle
            result = numpy.kron(result, across[int(d == axis), int(e == axis), odd[0]:, odd[1]:])
        return result

    stiffness = [[lame * product(i, j, i, j) + mu * product(i, j, j, i) for j in range(3)] for i in range(3)]
    for i in range(3):
        stiffness[i][i] += mu * sum(product(i, i, k, k) for k in range(3))
    return numpy.block(stiffness), [DENSITY * product(i, i, None, None) for i in range(3)]


def lowest_frequency(nu, parity, degree):
    """In Hz, by inverse iteration; and the number of unknowns."""
    stiffness, mass = matrices(nu, parity, degree)
    flexibility = numpy.linalg.inv(stiffness)
    starts = numpy.cumsum([0] + [len(block) for block in mass])

    def weighted(x):
        return numpy.concatenate([block @ x[a:b] for block, a, b in zip(mass, starts, starts[1:])])

    x, square, change = numpy.ones(len(stiffness)), 0, 1
    while change > 1e-12:
        load = weighted(x)
        x = flexibility @ load
        inertia = x @ weighted(x)
        change, square = abs(square * inertia / (x @ load) - 1), (x @ load) / inertia
        x /= numpy.sqrt(inertia)
    return numpy.sqrt(square) / (2 * numpy.pi), len(x)


for n in map(int, sys.argv[1:] or (2, 3, 4)):
    for what, nu, shape in [("bending", 0, BENDING), ("bending", 0.3, BENDING), ("axial", 0, AXIAL)]:
        f, unknowns = lowest_frequency(nu, shape, n)
        print(f"degree {n}, {unknowns} unknowns, {what}, nu = {nu}: {f:.6f} Hz", flush=True)
