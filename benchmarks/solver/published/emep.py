"""Chemistry of ozone by EMEP over 4.7 days, 66 species: Test Set for IVP Solvers, release 2.4."""

import numba as nb
import numpy as np

from benchmarks.solver.published.definitions import Published

#: Number of the rate, from 301 on of photolysis, then what reacts and what comes of it.
_REACTIONS = """
1 36>14; 5 1+36>2; 7 38>36; 8 38>2*37; 11 1+14>2; 12 2+14>39; 13 14+37>15; 14 14+15>37; 15 1+39>2*2
17 1+15>2+37; 19 2+39>1+2; 20 2+39>40; 21 2+37>16; 26 17+39>15+16; 29 40>2+39; 30 15+37>; 31 17+37>15
33 18+37>15; 35 16+37>39; 36 15+15>17; 39 3+37>15+21; 40 3+19>11+15+21; 43 17>; 43 22>; 43 40>2*42; 43 16>42
47 3>; 47 17>; 48 2>; 49 14>; 50 25>; 50 58>; 51 21>; 51 42>; 52 28>; 52 47>; 52 48>; 52 49>; 52 50>; 52 51>
52 52>; 52 53>; 52 56>; 52 62>; 52 63>; 52 64>; 52 65>; 52 66>; 53 11>; 53 12>; 53 13>; 59 5+37>19
60 1+19>2+11+15; 60 1+27>2+12+24; 60 1+26>2+.35*12+.65*13+.65*15+.35*23; 60 1+29>2+2*11+15
60 1+31>2+11+12+15; 60 1+33>2+15+30+34; 60 1+35>2+15+30+32
60 1+43>.86*2+.74*11+.78*15+.12*43+.42*44+.32*54+.14*55; 60 1+59>2+13+15
60 1+45>.95*2+.266*11+.684*12+.95*15+.684*24+.266*30+.05*55; 60 1+61>1.9*2+.95*12+.95*13+.05*15
60 1+60>1.1*2+.15*11+.8*15+.05*44+.1*54+.85*55; 61 19+19>2*11+2*15; 61 19+19>11+46; 63 37+46>11+15
64 20+37>12+15; 65 15+19>22; 66 11+37>4+15; 67 22+37>11+37; 68 22+37>19; 68 28+37>23; 68 37+47>24
68 37+49>26; 68 37+50>29; 68 37+51>31; 69 11+39>4+15+16; 70 4+37>15; 71 6+37>23; 72 1+23>2+12+15
74 15+23>28; 75 12+37>24; 76 28+37>12+37; 76 37+50>12+37; 76 37+49>13+37; 76 37+51>13+37; 77 2+24>25
77 2+57>58; 78 25>2+24; 78 58>2+57; 79 1+24>2+19; 79 1+57>2+59; 80 19+24>11+.5*15+.5*19; 81 7+37>26
85 15+26>49; 85 15+29>50; 85 15+31>51; 85 15+27>52; 85 15+57>66; 85 15+45>62; 85 15+61>65; 85 15+59>63
85 15+33>48; 85 15+35>53; 85 15+43>56; 85 15+60>64; 86 13+37>27; 87 37+52>27; 88 15+24>47; 89 15+24>14
94 24+24>2*19; 109 8+37>29; 112 8+14>.44*4+11+.12*15+.13*18; 125 9+37>31; 146 37+63>59
123 9+14>.4*4+.07*5+.5*11+.5*12+.28*15+.07*18+.31*19+.15*37; 147 37+64>60; 148 37+62>45; 149 37+65>61
149 37+66>57; 150 14+41>.05*4+.07*9+.8*11+.06*15+.3*36+.55*37+.26*44+.67*54; 151 37+41>43; 153 37+44>45
156 37+56>37+43; 157 14+56>.7*11; 158 37+54>.5*57; 160 14+44>.05*4+.8*11+.04*12+.06*15+.82*30+.2*36+.08*37
161 37+55>61; 163 39+41>60; 219 34+37>35; 221 32+37>2*4+15; 222 30+37>4+24; 223 37+53>35; 234 10+37>33
235 37+48>33; 301 14>36; 302 14>38; 303 2>1+36; 304 17>2*37; 305 16>2+37; 306 11>4+2*15; 307 11>4+18
307 32>4+11; 307 32>4+11; 308 12>4+15+19; 309 13>23+24; 311 30>4+15+24; 313 39>1; 314 39>2+36; 315 40>2+39
316 22>11+15+37; 316 28>12+15+37; 316 47>19+37; 316 49>.35*12+.65*13+.65*15+.35*23+37
316 50>1.56*11+.22*12+15+37; 316 51>11+12+15; 316 52>12+24+37; 316 48>15+30+34+37; 316 53>15+30+32+37
316 59>13+59
"""
#: Number of the rate, its factor, and the temperature in its exponent.
_ARRHENIUS = """
7 5.1e8 100; 11 1.8e-12 -1370; 12 1.2e-13 -2450; 13 1.9e-12 -1000; 14 1.4e-14 -600; 15 1.8e-11 110
17 3.7e-12 240; 19 7.2e-14 -1414; 29 7.1e14 -11080; 30 4.8e-11 250; 31 2.9e-12 -160; 33 7.7e-12 -2100
35 1e-14 785; 59 3.9e-12 -1885; 60 4.2e-12 180; 61 5.5e-14 365; 63 3.3e-12 -380; 65 3.8e-13 780
67 1e-12 190; 68 1.9e-12 190; 71 7.8e-12 -1020; 74 6.5e-13 650; 75 5.6e-12 310; 76 5.8e-12 190
78 1.34e16 -13330; 81 1.64e-11 -559; 88 1.3e-13 1040; 89 3e-13 1040; 94 2.8e-12 530; 109 1.66e-12 474
112 1.2e-14 -2630; 123 6.5e-15 -1880; 150 1.23e-14 -2013; 151 2.54e-11 410; 153 4.13e-12 452
158 1.86e-11 175; 160 4.32e-15 -2016; 20 1.4e-12 0; 21 1.4e-11 0; 26 4.1e-16 0; 39 1.35e-12 0; 40 4e-17 0
43 1e-4 0; 64 3.2e-12 0; 66 9.6e-12 0; 69 5.8e-16 0; 70 2.4e-13 0; 72 8.9e-12 0; 77 1e-11 0; 79 2e-11 0
80 1.1e-11 0; 85 1e-11 0; 86 1.15e-12 0; 87 4.8e-12 0; 125 2.86e-11 0; 146 3.2e-11 0; 147 2e-11 0
148 2.2e-11 0; 149 3.7e-11 0; 156 2e-11 0; 157 8e-18 0; 161 3.35e-11 0; 163 7.8e-13 0; 219 2e-11 0
221 1.1e-11 0; 222 1.7e-11 0; 223 2.4e-11 0; 234 1.37e-11 0; 235 1.7e-11 0
"""
_SUN = np.array([
    [1.23e-3, 2e-4, 1.45e-2, 2.2e-5, 3e-6, 5.4e-5, 6.65e-5, 1.35e-5, 2.43e-5, 5.4e-4, 2.16e-4, 5.4e-5,
     3.53e-2, 8.94e-2, 3.32e-5, 2.27e-5],
    [0.6, 1.4, 0.4, 0.75, 1.25, 0.79, 0.6, 0.94, 0.88, 0.79, 0.79, 0.79, 0.081, 0.059, 0.57, 0.62],
])  # fmt: skip
#: Speeds at which 47 to 53 are deposited, in cm/s, by day.
_DEPOSITED = np.array([0.5, 0.2, 0.5, 0.2, 0.1, 0.5, 0.3])
_SHARES = np.array([0.07689, 0.41444, 0.03642, 0.03827, 0.24537, 0.13957])
_MASSES = np.array([30.0, 58.0, 28.0, 42.0, 106.0, 46.0])
_M, _T, _HEIGHT = 2.55e19, 298.0, 1.2e5


def _entries(text):
    return [line.strip() for line in text.replace("\n", ";").split(";") if line.strip()]


def _tables():
    """Return constant rates, reactions by rate and reactants, their changes of species, and emissions."""
    rates, reactions, changes, emitted = np.zeros(317), [], [], np.zeros(66)
    for number, factor, temperature in map(str.split, _entries(_ARRHENIUS)):
        rates[int(number)] = float(factor) * np.exp(float(temperature) / _T)
    rates[1] = 5.7e-34 * (_T / 300.0) ** -2.8 * _M * 5.2e18
    rates[5] = 9.6e-32 * (_T / 300.0) ** -1.6 * _M
    for k, (number, text) in enumerate(map(str.split, _entries(_REACTIONS))):
        left, right = ([part for part in side.split("+") if part] for side in text.split(">"))
        reactions.append((int(number), int(left[0]) - 1, int(left[1]) - 1 if len(left) > 1 else -1))
        changes += [(k, int(species) - 1, -1.0) for species in left]
        changes += [
            (k, int(part.split("*")[-1]) - 1, float(part.split("*")[0]) if "*" in part else 1.0)
            for part in right
        ]
    emitted[[0, 2, 3, 20, 40]] = np.array([1.0, 1.0, 10.0, 0.05, 0.5]) * 2.5e11
    emitted[[5, 6, 7, 8, 9, 19]] = 2.5e11 * _SHARES / _MASSES / np.sum(_SHARES / _MASSES)
    return rates, np.array(reactions), np.array(changes), emitted / _HEIGHT


_RATES, _REACTING, _CHANGES, _EMITTED = _tables()


@nb.njit
def _emep(t, y):
    """Return the rates of all species; the first day begins at time 0."""
    time = t % 86400.0
    rates, latitude, declination = _RATES.copy(), np.pi * 50.0 / 180.0, np.pi * 23.5 / 180.0
    night = time < 14400.0 or time >= 72000.0
    humidity = 23.0 * np.sin(2.43 - 7.93e-5 * time) + 66.5
    warm = (597.3 - 0.57 * (_T - 273.16)) * 18.0 / 1.986 * (1.0 / _T - 1.0 / 273.16)
    water = 6.1078 * np.exp(-warm) * 10.0 / (1.38e-16 * _T) * humidity
    rates[8] = 2.2e-10 * water
    rates[36] = (2.3e-13 * np.exp(600.0 / _T) + _M * 1.7e-33 * np.exp(1000.0 / _T)) * (
        1.0 + 1.4e-21 * water * np.exp(2200.0 / _T)
    )
    rates[47:54] = _DEPOSITED / _HEIGHT * (0.25 if night else 1.0)
    hour = (1.0 + time / 43200.0) * np.pi
    height = np.cos(hour) * np.cos(latitude) * np.cos(declination) + np.sin(latitude) * np.sin(declination)
    for k in range(16):
        rates[301 + k] = 1e-40 if night else _SUN[0, k] * np.exp(-_SUN[1, k] / height)
    flows = np.empty(len(_REACTING))
    for k in range(flows.size):
        number, first, second = _REACTING[k]
        flows[k] = rates[number] * y[first] * (y[second] if second >= 0 else 1.0)
    f = _EMITTED.copy()
    for k in range(len(_CHANGES)):
        f[int(_CHANGES[k, 1])] += _CHANGES[k, 2] * flows[int(_CHANGES[k, 0])]
    return f


def emep() -> Published:
    """Return the chemistry; light and deposition jump at four in the morning and at eight in the evening."""
    y0 = np.append(np.full(13, 1e7), np.full(53, 100.0))
    y0[[0, 1, 2, 3, 4, 13, 37]] = 1e9, 5e9, 5e9, 3.8e12, 3.5e13, 5e11, 1e-3
    known = np.array([0, 1, 2, 4, 13, 39])
    end = [2.564580511140732e7, 5.146134770952715e10, 2.315679957701715e11, 3.459285326034955e13]
    end += [3.150308585365321e12, 7.684596616753747e8]
    jumps = [3600.0 * (24 * day + hour) for day in range(5) for hour in (4, 20)]
    t_end = np.nextafter(jumps[-1], 0.0)
    return Published(_emep, y0, t_end, known, np.array(end), {"breakpoints": jumps[1:-1]}, jumps[0], 1e6)
