* Nine feeds blended to four fuels: octane, sulphur, ranges of demand, free sums, scarce feeds. Optimum
* 3480: the prices of the rows and the plan below satisfy complementary slackness, in whole numbers.
* Prices: FEED1 -518, FEED2 -496, FEED3 -502, FEED4 -524, FEED5 -520, FEED6 -512,
*         FEED7 -480, FEED8 -508, FEED9 -494, OCT1 2, OUT1 500, DEM1 26,
*         OCT2 3, OUT2 497, OCT3 2, OUT3 500, DEM3 33, OCT4 2,
*         OUT4 504.
* Plan: B13 15, B23 36, B24 32, B31 16, B32 22, B34 22,
*       B43 10, B61 30, B62 11, B71 36, B72 5, B74 29,
*       BUY1 15, BUY2 68, BUY3 60, BUY4 10, BUY6 41, BUY7 70,
*       FUEL1 82, FUEL2 38, FUEL3 61, FUEL4 83.
NAME          BLENDING
ROWS
 N  COST
 E  FEED1
 E  FEED2
 E  FEED3
 E  FEED4
 E  FEED5
 E  FEED6
 E  FEED7
 E  FEED8
 E  FEED9
 G  OCT1
 L  SUL1
 G  OCT2
 L  SUL2
 G  OCT3
 L  SUL3
 G  OCT4
 L  SUL4
 E  OUT1
 E  OUT2
 E  OUT3
 E  OUT4
 G  DEM1
 G  DEM2
 G  DEM3
 G  DEM4
COLUMNS
    B11       COST                 4   FEED1                1
    B11       OUT1                 1   OCT1                11
    B11       SUL1                -4
    B12       COST                12   FEED1                1
    B12       OUT2                 1   OCT2                 8
    B12       SUL2                -3
    B13       COST                -6   FEED1                1
    B13       OUT3                 1   OCT3                 6
    B13       SUL3                -2
    B14       COST                12   FEED1                1
    B14       OUT4                 1   OCT4                13
    B14       SUL4                -6
    B21       COST                10   FEED2                1
    B21       OUT1                 1   SUL1                -2
    B22       COST                11   FEED2                1
    B22       OUT2                 1   OCT2                -3
    B22       SUL2                -1
    B23       COST                -6   FEED2                1
    B23       OUT3                 1   OCT3                -5
    B24       COST                12   FEED2                1
    B24       OUT4                 1   OCT4                 2
    B24       SUL4                -4
    B31       COST                 4   FEED3                1
    B31       OUT1                 1   OCT1                 3
    B31       SUL1                -3
    B32       COST                -5   FEED3                1
    B32       OUT2                 1   SUL2                -2
    B33       COST                 5   FEED3                1
    B33       OUT3                 1   OCT3                -2
    B33       SUL3                -1
    B34       COST                12   FEED3                1
    B34       OUT4                 1   OCT4                 5
    B34       SUL4                -5
    B41       COST                12   FEED4                1
    B41       OUT1                 1   OCT1                14
    B41       SUL1                 1
    B42       COST                 6   FEED4                1
    B42       OUT2                 1   OCT2                11
    B42       SUL2                 2
    B43       COST                -6   FEED4                1
    B43       OUT3                 1   OCT3                 9
    B43       SUL3                 3
    B44       COST                12   FEED4                1
    B44       OUT4                 1   OCT4                16
    B44       SUL4                -1
    B51       COST                 8   FEED5                1
    B51       OUT1                 1   OCT1                12
    B51       SUL1                 3
    B52       COST                 7   FEED5                1
    B52       OUT2                 1   OCT2                 9
    B52       SUL2                 4
    B53       COST                10   FEED5                1
    B53       OUT3                 1   OCT3                 7
    B53       SUL3                 5
    B54       COST                12   FEED5                1
    B54       OUT4                 1   OCT4                14
    B54       SUL4                 1
    B61       COST                 4   FEED6                1
    B61       OUT1                 1   OCT1                 8
    B61       SUL1                -1
    B62       FEED6                1   OUT2                 1
    B62       OCT2                 5
    B63       COST                 8   FEED6                1
    B63       OUT3                 1   OCT3                 3
    B63       SUL3                 1
    B64       COST                12   FEED6                1
    B64       OUT4                 1   OCT4                10
    B64       SUL4                -3
    B71       COST                 4   FEED7                1
    B71       OUT1                 1   OCT1                -8
    B71       SUL1                 2
    B72       COST               -16   FEED7                1
    B72       OUT2                 1   OCT2               -11
    B72       SUL2                 3
    B73       COST                11   FEED7                1
    B73       OUT3                 1   OCT3               -13
    B73       SUL3                 4
    B74       COST                12   FEED7                1
    B74       OUT4                 1   OCT4                -6
    B81       COST                 5   FEED8                1
    B81       OUT1                 1   OCT1                 6
    B81       SUL1                 4
    B82       COST                 5   FEED8                1
    B82       OUT2                 1   OCT2                 3
    B82       SUL2                 5
    B83       COST                10   FEED8                1
    B83       OUT3                 1   OCT3                 1
    B83       SUL3                 6
    B84       COST                12   FEED8                1
    B84       OUT4                 1   OCT4                 8
    B84       SUL4                 2
    B91       COST                11   FEED9                1
    B91       OUT1                 1   OCT1                -1
    B91       SUL1                -3
    B92       COST                 4   FEED9                1
    B92       OUT2                 1   OCT2                -4
    B92       SUL2                -2
    B93       COST                 9   FEED9                1
    B93       OUT3                 1   OCT3                -6
    B93       SUL3                -1
    B94       COST                12   FEED9                1
    B94       OUT4                 1   OCT4                 1
    B94       SUL4                -5
    BUY1      COST               511   FEED1               -1
    BUY2      COST               496   FEED2               -1
    BUY3      COST               502   FEED3               -1
    BUY4      COST               517   FEED4               -1
    BUY5      COST               529   FEED5               -1
    BUY6      COST               512   FEED6               -1
    BUY7      COST               473   FEED7               -1
    BUY8      COST               517   FEED8               -1
    BUY9      COST               503   FEED9               -1
    FUEL1     COST              -474   OUT1                -1
    FUEL1     DEM1                 1
    FUEL2     COST              -497   OUT2                -1
    FUEL2     DEM2                 1
    FUEL3     COST              -467   OUT3                -1
    FUEL3     DEM3                 1
    FUEL4     COST              -504   OUT4                -1
    FUEL4     DEM4                 1
RHS
    RHS       DEM1                82
    RHS       DEM2                28
    RHS       DEM3                61
    RHS       DEM4                73
RANGES
    RNG       DEM1                30
    RNG       DEM2                30
    RNG       DEM3                30
    RNG       DEM4                30
BOUNDS
 UP BND       BUY1                15
 UP BND       BUY2               118
 UP BND       BUY3               110
 UP BND       BUY4                10
 UP BND       BUY5                50
 UP BND       BUY6                91
 UP BND       BUY7                70
 UP BND       BUY8                50
 UP BND       BUY9                50
 FR BND       FUEL1
 FR BND       FUEL2
 FR BND       FUEL3
 FR BND       FUEL4
ENDATA
