"""Writes steps.json: F, M, B and Q of motion models over steps from 1e-6 to 1e3 time constants, with 150 digits.

By eigenvalues (not by series and doubling as in the library): A = V diag(l) V^-1, so
F = V exp(l h) V^-1, int F = V ((exp(l h) - 1) / l) V^-1, Q = V (C_ij (exp((l_i + l_j) h) - 1) / (l_i + l_j)) V', with
C = V^-1 W V^-T. Critical damping is changed by 1e-60. `scale` of an entry of F, M or B is its
largest size over the step; an entry of Q is measured by its row's and column's deviation.
Run: python3 steps.py (needs mpmath).
"""
import json, pathlib
from mpmath import mp, mpf, matrix, eig, exp, diag, sqrt, mpc
mp.dps = 150
STEPS = ["1e-6", "1e-3", "0.1", "0.5", "1", "3", "30", "1e3"]

def relative(z, h):
    return h if abs(z) < mpf(10) ** -120 else mp.expm1(z * h) / z
def real(m, s, t):
    return [[float(m[i, j].real) for j in range(t)] for i in range(s)]

class Model:
    def __init__(self, name, motion, A, W, b=None, B=None, tau=1):
        self.name, self.motion, self.tau = name, motion, mpf(tau)
        self.s = s = len(A)
        A, self.W = matrix(A), matrix(W)
        self.b = matrix(b or [0] * s)
        self.B = matrix(B or [[0]] * s)
        self.l, self.V = eig(A)
        self.U = self.V ** -1
        self.C = self.U * self.W * self.U.T
    def step(self, h):
        s = self.s
        F = self.V * diag([exp(l * h) for l in self.l]) * self.U
        I = self.V * diag([relative(l, h) for l in self.l]) * self.U
        Q = matrix(s, s)
        for i in range(s):
            for j in range(s): Q[i, j] = self.C[i, j] * relative(self.l[i] + self.l[j], h)
        return F, I * self.b, I * self.B, self.V * Q * self.V.T
    def rows(self):
        for c in STEPS:
            h = float(mpf(c) * self.tau)
            F, M, B, Q = self.step(mpf(h))
            sizes = [self.step(mpf(h) * mpf(k) / 64)[:3] for k in range(65)]
            scale = lambda n, t: [[max(float(abs(z[n][i, j])) for z in sizes) for j in range(t)] for i in range(self.s)]
            d = self.B.cols
            yield {"step": h, "transition": real(F, self.s, self.s), "offset": real(M, self.s, 1), "gain": real(B, self.s, d),
                   "noise": real(Q, self.s, self.s), "scale": {"transition": scale(0, self.s), "offset": scale(1, 1), "gain": scale(2, d)}}

def spring(k, c, n):
    k, c, n = mpf(k), mpf(c), mpf(n)
    # critical damping: apart by 1e-60, so that the eigenvectors are
    extra = mpf(10) ** -60 if c * c == 4 * k else 0
    return Model(f"spring {k} {c}", {"type": "equilibriumRevertingVelocity", "dimensions": 1, "noise": float(n), "stiffness": float(k), "damping": float(c)},
                 [[0, 1], [-k, -c - extra]], [[0, 0], [0, n * n]], B=[[0], [k]], tau=1 / sqrt(k))
def integrated(c, u, n):
    c, u, n = mpf(c), mpf(u), mpf(n)
    return Model(f"integrated {c}", {"type": "integratedOrnsteinUhlenbeck", "dimensions": 1, "noise": float(n), "damping": float(c), "drift": float(u)},
                 [[0, 1], [0, -c]], [[0, 0], [0, n * n]], b=[0, c * u], tau=1 / c)
def custom(name, A, W, b, B, tau):
    return Model(name, {"type": "custom", "dimensions": len(B[0]), "drift": A, "diffusion": W, "offset": b, "destinationGain": B}, A, W, b, B, tau)

MODELS = [
    integrated(1.5, 0.25, 2), integrated(2.0 ** -10, -3, 1), integrated(1024, 8, 100),
    Model("reverting", {"type": "meanReverting", "dimensions": 1, "noise": 1.5, "rate": 0.75}, [[-0.75]], [[2.25]], B=[[0.75]], tau=1 / 0.75),
    spring(4, 3, 2), spring(4, 4, 1), spring(4, 9, 1), spring(4, 0, 1), spring(1, 1024, 1), spring(65536, 2, 1), spring(4, 4.0000001, 1),
    custom("coupled", [[0, 0, 1, 0], [0, 0, 0, 1], [-1, 0, -1.25, 0.25], [0, -1, -0.25, -1.25]],
           [[0, 0, 0, 0], [0, 0, 0, 0], [0, 0, 4, 0.5], [0, 0, 0.5, 4]], [0, 0, 0.125, 0], [[0, 0], [0, 0], [1, 0], [0, 1]], 1),
    custom("fast and slow", [[-0.0009765625, 1, 0], [0, -1, 8], [0, 0, -1024]], [[0.25, 0, 0], [0, 1, 0.5], [0, 0.5, 64]], [1, 0, 2], [[0.5], [0], [0]], 1),
]
if __name__ == "__main__":
    out = [{"name": m.name, "motion": m.motion, "steps": list(m.rows())} for m in MODELS]
    pathlib.Path(__file__).with_name("steps.json").write_text(json.dumps(out))
