* Rows: 10 with R = -4 is [6, 10]; 10 with R = 4 is [10, 14]; L 9 with R = -3 is [6, 9];
* G 2 with |R| = 5 is [2, 7]; E with R = 0 stays 3. min x1 - x2 + x3 - x4 + x5 = 6 - 14 + 6 - 7 + 3 = -6.
NAME          RANGES
ROWS
 N  COST
 E  E1
 E  E2
 L  L1
 G  G1
 E  E3
COLUMNS
    X1        COST                 1   E1                   1
    X2        COST                -1   E2                   1
    X3        COST                 1   L1                   1
    X4        COST                -1   G1                   1
    X5        COST                 1   E3                   1
RHS
    RHS       E1                  10   E2                  10
    RHS       L1                   9   G1                   2
    RHS       E3                   3
RANGES
    RNG       E1                  -4   E2                   4
    RNG       L1                  -3   G1                   5
    RNG       E3                   0
ENDATA
